#include "illuminance/reflected_sharing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/parallel.h"
#include "core/random.h"

namespace tenku {
namespace {

constexpr double kNormalSteps = 50.0;  // of a normal's component that counts as one plane
constexpr double kOffsetSteps = 2.0;   // a metre
constexpr double kFacingSteps = 4.0;   // of a normal's component that counts as one way
constexpr double kWideCell_m = 50.0;   // beyond, a cell holds many surfaces
constexpr double k95 = 1.96;           // standard errors in an interval

bool is_flat_normal(Vec3 normal) { return std::abs(normal.z) > 0.9; }

std::uint64_t plane_of(Vec3 n, Vec3 p) {
  // A gently rolling ground is one surface: only what is steep is told apart by its offset.
  const bool flat = is_flat_normal(n);
  const double steps = flat ? kNormalSteps / 10.0 : kNormalSteps;
  const double offset = flat ? 0.0 : kOffsetSteps * dot(n, p);
  return mix_rounded(0, {steps * n.x, steps * n.y, steps * n.z, offset});
}

}  // namespace

std::uint64_t facing(Vec3 normal) {
  return mix_rounded(0,
                     {kFacingSteps * normal.x, kFacingSteps * normal.y, kFacingSteps * normal.z});
}

SharingLayout sharing_by_distance(const Sensors& sensors, double distance_m) {
  SharingLayout layout;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    layout.place.push_back((1.0 / distance_m) * sensors.position[s]);
    layout.surface.push_back(distance_m > kWideCell_m
                                 ? facing(sensors.normal[s])
                                 : plane_of(sensors.normal[s], sensors.position[s]));
  }
  return layout;
}

ReflectedSharing::ReflectedSharing(const Sensors& sensors, SharingLayout layout)
    : sensors_(sensors), layout_(std::move(layout)) {
  bool is_level = true;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    is_level &= layout_.place[s].z == layout_.place[0].z;
    if (place_.emplace(cell_key(s, {}), representative_.size()).second) {
      representative_.push_back(s);
    }
  }
  const int reach = layout_.reach, up = is_level ? 0 : reach;
  for (int k = -up; k <= up; ++k) {
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) {
        steps_.push_back({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
      }
    }
  }
}

std::uint64_t ReflectedSharing::cell_key(std::size_t sensor, Vec3 steps_away) const {
  const Vec3 place = layout_.place[sensor];
  return mix_rounded(layout_.surface[sensor],
                     {std::floor(place.x) + steps_away.x, std::floor(place.y) + steps_away.y,
                      std::floor(place.z) + steps_away.z});
}

bool ReflectedSharing::is_seen(std::size_t sensor, std::size_t other,
                               const RayVisibility& rays) const {
  const Vec3 at = sensors_.position[sensor] + rays.lift_m() * sensors_.normal[sensor];
  const Vec3 way = sensors_.position[other] + rays.lift_m() * sensors_.normal[other] - at;
  const double away = length(way);
  if (!(away > 1e-6)) return true;
  const auto hit = rays.first_hit(at, (1.0 / away) * way);
  return !hit || hit->distance_m >= away;
}

ReflectedSharing::Blend ReflectedSharing::blend_at(std::size_t sensor, bool without_itself,
                                                   const SensorIlluminance& results,
                                                   const RayVisibility& rays) const {
  Blend blend;
  double mean_error = 0.0;
  for (const Vec3 step : steps_) {
    const auto found = place_.find(cell_key(sensor, step));
    if (found == place_.end()) continue;
    const std::size_t other = representative_[found->second];
    if (other == sensor && without_itself) continue;
    if (layout_.must_see && !is_seen(sensor, other, rays)) continue;
    const double away = length(layout_.place[other] - layout_.place[sensor]) / layout_.reach;
    const double w = std::exp(-away * away) + 1e-6;
    blend.lux += w * results.reflected_lux[found->second];
    blend.error_lux += std::pow(w * results.error_lux[found->second], 2);  // independent
    mean_error += w * results.error_lux[found->second];
    blend.weight += w;
  }
  if (blend.weight > 0.0) {
    blend.lux /= blend.weight;
    blend.error_lux =
        (layout_.is_measured ? std::sqrt(blend.error_lux) : mean_error) / blend.weight;
  }
  return blend;
}

bool ReflectedSharing::is_flat(std::size_t sensor) const {
  return is_flat_normal(sensors_.normal[sensor]);
}

double ReflectedSharing::missed_lux(bool flat, const SensorIlluminance& of_representatives,
                                    const RayVisibility& rays) const {
  if (!layout_.is_measured) return 0.0;
  std::vector<double> squares(representative_.size());
  std::vector<std::uint8_t> is_known(representative_.size());
  parallel_for(representative_.size(), 256, [&](IndexRange range) {
    for (std::size_t r = range.begin; r < range.end; ++r) {
      if (is_flat(representative_[r]) != flat) continue;
      const Blend blend = blend_at(representative_[r], true, of_representatives, rays);
      if (!(blend.weight > 0.0)) continue;
      const double missed = blend.lux - of_representatives.reflected_lux[r];
      const double noise = std::hypot(blend.error_lux, of_representatives.error_lux[r]) / k95;
      squares[r] = missed * missed - noise * noise;
      is_known[r] = 1;
    }
  });
  double sum = 0.0, count = 0.0;
  for (std::size_t r = 0; r < squares.size(); ++r) {
    if (is_known[r]) sum += squares[r], count += 1.0;
  }
  return sum > 0.0 ? std::sqrt(sum / count) : 0.0;
}

void ReflectedSharing::spread(const SensorIlluminance& of_representatives,
                              const RayVisibility& rays, SensorIlluminance& all) const {
  const std::array<double, 2> missed{missed_lux(false, of_representatives, rays),
                                     missed_lux(true, of_representatives, rays)};
  parallel_for(sensors_.size(), 256, [&](IndexRange range) {
    for (std::size_t s = range.begin; s < range.end; ++s) {
      const std::size_t own = place_.at(cell_key(s, {}));
      Blend blend = blend_at(s, false, of_representatives, rays);
      if (representative_[own] == s || !(blend.weight > 0.0)) {
        blend = {of_representatives.reflected_lux[own], of_representatives.error_lux[own], 1.0};
      }
      all.reflected_lux[s] = blend.lux;
      const double shared = representative_[own] == s ? 0.0 : k95 * missed[is_flat(s)];
      all.error_lux[s] = std::sqrt(all.error_lux[s] * all.error_lux[s] +
                                   blend.error_lux * blend.error_lux + shared * shared);
    }
  });
}

}  // namespace tenku
