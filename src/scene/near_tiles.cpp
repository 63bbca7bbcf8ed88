#include "scene/near_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "scene/georeference.h"
#include "scene/placement.h"
#include "scene/terrain.h"

namespace tenku {
namespace {

constexpr double kRoof_m = 3.0;  // that LOD 1 may be too high or too low
constexpr double kMetresPerDegree = 111320.0;

/// Lengths of a unit along the axes of the file.
Vec3 metres_per_unit(const TileHead& head, const PlaceLookedAt& place, const ReadOptions& options) {
  const std::string& name = options.crs.empty() ? head.crs : options.crs;
  if (name.empty()) return {options.scale, options.scale, options.scale};
  const Crs crs = Crs::parse(name);
  if (!crs.geographic) {
    const double unit = options.scale * crs.metres_per_unit;
    return {unit, unit, unit};
  }
  const bool latitude_first =
      is_latitude_first(crs, {place.x, place.y, 0.0}, head.has_registry_axes);
  const double latitude = latitude_first ? place.x : place.y;
  const double east = kMetresPerDegree * std::cos(Angle::degrees(latitude).in_radians());
  return latitude_first ? Vec3{kMetresPerDegree, east, 1.0} : Vec3{east, kMetresPerDegree, 1.0};
}

double distance_m(const Extent& box, const PlaceLookedAt& place, Vec3 unit) {
  const double dx = std::max({0.0, box.min.x - place.x, place.x - box.max.x}) * unit.x;
  const double dy = std::max({0.0, box.min.y - place.y, place.y - box.max.y}) * unit.y;
  return std::max(0.0, std::hypot(dx, dy) - std::sqrt(2.0) * place.half_m);
}

}  // namespace

TileChoice choose_tiles(std::span<const TileHead> tiles, const PlaceLookedAt& place,
                        const ReadOptions& options) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double angle = skyline_angle(options.tolerance_pct);
  TileChoice choice{{}, kNever, kRoof_m / angle};
  const Vec3 unit = metres_per_unit(tiles.front(), place, options);
  std::vector<double> away;
  double lowest = kNever;
  for (const TileHead& tile : tiles) {
    away.push_back(tile.box ? distance_m(*tile.box, place, unit) : 0.0);
    if (tile.box && away.back() == 0.0) lowest = std::min(lowest, tile.box->min.z);
  }
  if (std::none_of(away.begin(), away.end(), [](double d) { return d == 0.0; })) {
    throw InputError(fmt::format("--around: no tile reaches within {:g} m of ({}, {})",
                                 place.half_m, place.x, place.y));
  }
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const double rise_m = tiles[t].box ? (tiles[t].box->max.z - lowest) * unit.z : kNever;
    if (away[t] > 0.0 && rise_m <= angle * away[t]) {
      choice.use.push_back(TileUse::Out);
      choice.least_out_m = std::min(choice.least_out_m, away[t]);
    } else {
      choice.use.push_back(away[t] > choice.coarse_m ? TileUse::Coarse : TileUse::Whole);
    }
  }
  return choice;
}

void tell_of_tiles(const TileChoice& choice, const PlaceLookedAt& place, const ReadOptions& options,
                   FindingCounter& findings) {
  const auto count = [&](TileUse use) {
    return static_cast<std::size_t>(std::count(choice.use.begin(), choice.use.end(), use));
  };
  const double degrees = Angle::radians(skyline_angle(options.tolerance_pct)).in_degrees();
  const auto note = [&](const char* code, TileUse use, std::string what, std::string repair) {
    if (count(use) == 0) return;
    Finding finding{code, Severity::Note, "", "", std::move(what), std::move(repair)};
    finding.count = count(use);
    findings.add(finding);
  };
  note("tiles_left_out", TileUse::Out,
       fmt::format(
           "{} of {} tiles, the nearest {:.0f} m away, rise by less than {:.2g} degrees over "
           "the horizon of what lies within {:g} m",
           count(TileUse::Out), choice.use.size(), choice.least_out_m, degrees, place.half_m),
       fmt::format("not read: all around they would take {:.2g} % of the light of an open wall",
                   kSkylineShare * options.tolerance_pct));
  note("tiles_coarse", TileUse::Coarse,
       fmt::format(
           "{} tiles are more than {:.0f} m away, where {:g} m of a roof are seen under less "
           "than {:.2g} degrees",
           count(TileUse::Coarse), choice.coarse_m, kRoof_m, degrees),
       "read at LOD 1 where they have it");
}

}  // namespace tenku
