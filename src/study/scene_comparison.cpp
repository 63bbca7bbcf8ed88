#include "study/scene_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "illuminance/planned_light.h"

namespace tenku {
namespace {

constexpr double kDarkShare = 0.01;                    // of open light, the least a share is of
constexpr double kSunDiffers = 0.1;                    // of the sun's light in the open
constexpr double kShare = 4.0;                         // spacings that share reflected light
constexpr std::array<double, 2> kSkyBands{0.4, 0.75};  // sky views between bands

void refuse_other_places(const Scene& first, const Scene& second) {
  if (first.georeference.has_value() != second.georeference.has_value()) {
    throw InputError("one scene has a place on Earth and the other has none; give --crs");
  }
  if (first.georeference && first.georeference->crs != second.georeference->crs) {
    throw InputError("the scenes are in " + first.georeference->crs + " and " +
                     second.georeference->crs + "; --crs gives both the same");
  }
}

/// The squares of the first scene that are open in the second as well, and where they are there.
Sensors keep_open_in_both(const LitScene& first, const LitScene& second, GroundPlan& plan) {
  const double top = second.extent().max.z + 1.0;
  std::vector<std::optional<Vec3>> at(plan.cell.size());
  parallel_for(at.size(), 256, [&](IndexRange range) {
    for (std::size_t k = range.begin; k < range.end; ++k) {
      const Vec3 on_map = first.scene().map_frame.to_file(plan.sensors.position[k]);
      const Vec3 there = second.scene().map_frame.to_local(on_map);
      at[k] = ground_below(second, {there.x, there.y, top});
    }
  });
  std::vector<std::uint32_t> kept;
  Sensors in_second;
  for (std::uint32_t k = 0; k < at.size(); ++k) {
    if (!at[k]) continue;
    kept.push_back(k);
    in_second.position.push_back(*at[k]);
    in_second.normal.push_back(kZenith);
  }
  plan.sensors = sensors_of(plan.sensors, kept);
  std::vector<std::size_t> cell;
  for (const std::uint32_t k : kept) cell.push_back(plan.cell[k]);
  plan.cell = std::move(cell);
  return in_second;
}

SensorIlluminance light_of(const ComparedScene& scene, const Sensors& sensors,
                           const IlluminanceOptions& options, const LightMethod& method,
                           double share_m, Progress& progress) {
  IlluminanceOptions how = options;
  how.reflection = scene.reflection;
  how.share_reflected_m = share_m;
  return illuminate(sensors, scene.lit.engines(), scene.lit.source(), how, method, progress).values;
}

double quantile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5)];
}

ComparisonRow row_of(const SceneComparison& c, double most_sun, std::string which,
                     const std::vector<std::size_t>& squares) {
  ComparisonRow row;
  row.which = std::move(which);
  row.squares = squares.size();
  if (squares.empty()) return row;
  const auto count = static_cast<double>(squares.size());
  std::vector<double> sizes;
  for (const std::size_t k : squares) {
    row.mean_pct += c.difference_pct[k] / count;
    sizes.push_back(std::abs(c.difference_pct[k]));
    const double sun = std::abs(c.first.sun_lux[k] - c.second.sun_lux[k]);
    row.sun_differs += sun > kSunDiffers * most_sun ? 1.0 / count : 0.0;
    for (std::size_t p = 0; p < kWithin_pct.size(); ++p) {
      row.within[p] += sizes.back() <= kWithin_pct[p] ? 1.0 / count : 0.0;
    }
  }
  std::sort(sizes.begin(), sizes.end());
  row.median_pct = quantile(sizes, 0.5);
  row.p95_pct = quantile(sizes, 0.95);
  row.worst_pct = sizes.back();
  return row;
}

}  // namespace

SceneComparison compare_scenes(const ComparedScene& first, const ComparedScene& second,
                               const IlluminanceOptions& options, const LightMethod& method,
                               double spacing_m, Progress& progress) {
  refuse_other_places(first.lit.scene(), second.lit.scene());
  SceneComparison made;
  made.plan = ground_plan(first.lit, spacing_m);
  const std::size_t open = made.plan.cell.size();
  const Sensors there = keep_open_in_both(first.lit, second.lit, made.plan);
  made.covered = open - made.plan.cell.size();
  if (there.size() == 0) throw InputError("no open ground lies in both scenes");
  const double share_m = kShare * made.plan.grid.cell_m;
  made.first = light_of(first, made.plan.sensors, options, method, share_m, progress);
  made.second = light_of(second, there, options, method, share_m, progress);
  const double least = kDarkShare * first.lit.source().unobstructed_lux();
  for (std::size_t k = 0; k < there.size(); ++k) {
    const double whole = std::max(made.first.total_lux(k), least);
    const double off = made.second.total_lux(k) - made.first.total_lux(k);
    made.difference_pct.push_back(whole > 0.0 ? 100.0 * off / whole : 0.0);
    const double error = std::hypot(made.first.error_lux[k], made.second.error_lux[k]);
    made.error_pct.push_back(whole > 0.0 ? 100.0 * error / whole : 0.0);
    made.plan.grid.values[made.plan.cell[k]] = std::abs(made.difference_pct.back());
  }
  return made;
}

std::vector<ComparisonRow> comparison_table(const SceneComparison& c) {
  std::vector<std::size_t> all, deep, streets, open;
  double most_sun = 0.0;
  for (std::size_t k = 0; k < c.difference_pct.size(); ++k) {
    all.push_back(k);
    most_sun = std::max({most_sun, c.first.sun_lux[k], c.second.sun_lux[k]});
    const double view = c.first.sky_view[k];
    (view < kSkyBands[0] ? deep : view < kSkyBands[1] ? streets : open).push_back(k);
  }
  return {row_of(c, most_sun, "all", all), row_of(c, most_sun, "sky view over 0.75", open),
          row_of(c, most_sun, "sky view 0.4 to 0.75", streets),
          row_of(c, most_sun, "sky view under 0.4", deep)};
}

}  // namespace tenku
