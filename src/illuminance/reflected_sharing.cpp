#include "illuminance/reflected_sharing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"

namespace tenku {
namespace {

constexpr double kNormalSteps = 50.0;  // of a normal's component that counts as one plane
constexpr double kOffsetSteps = 2.0;   // a metre

}  // namespace

ReflectedSharing::ReflectedSharing(const Sensors& sensors, double distance_m)
    : sensors_(sensors), distance_m_(distance_m) {
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    if (place_.emplace(key_of(cell_of(s)), representative_.size()).second) {
      representative_.push_back(s);
    }
  }
}

ReflectedSharing::Cell ReflectedSharing::cell_of(std::size_t sensor) const {
  const Vec3 n = sensors_.normal[sensor], p = sensors_.position[sensor];
  std::uint64_t plane = 0;
  // A gently rolling ground is one surface: only what is steep is told apart by its offset.
  const double offset = is_flat(sensor) ? 0.0 : kOffsetSteps * dot(n, p);
  for (const double part : {kNormalSteps * n.x, kNormalSteps * n.y, kNormalSteps * n.z, offset}) {
    const double step = is_flat(sensor) ? part / 10.0 : part;
    plane = mix_bits(plane + static_cast<std::uint64_t>(std::llround(step)));
  }
  const auto index = [&](double x) {
    return static_cast<std::int64_t>(std::floor(x / distance_m_));
  };
  return {plane, index(p.x), index(p.y), index(p.z)};
}

std::uint64_t ReflectedSharing::key_of(const Cell& cell) {
  std::uint64_t key = cell.plane;
  for (const std::int64_t x : {cell.i, cell.j, cell.k}) {
    key = mix_bits(key + static_cast<std::uint64_t>(x));
  }
  return key;
}

ReflectedSharing::Blend ReflectedSharing::blend_at(std::size_t sensor, bool without_itself,
                                                   const SensorIlluminance& results,
                                                   const RayVisibility& rays) const {
  const Cell middle = cell_of(sensor);
  const Vec3 at = sensors_.position[sensor] + rays.lift_m() * sensors_.normal[sensor];
  Blend blend;
  for (int n = 0; n < 27; ++n) {
    const Cell cell{middle.plane, middle.i + n % 3 - 1, middle.j + n / 3 % 3 - 1,
                    middle.k + n / 9 - 1};
    const auto found = place_.find(key_of(cell));
    if (found == place_.end()) continue;
    const std::size_t other = representative_[found->second];
    if (other == sensor && without_itself) continue;
    const Vec3 way = sensors_.position[other] + rays.lift_m() * sensors_.normal[other] - at;
    const double away = length(way);
    if (away > 1e-6) {
      const auto hit = rays.first_hit(at, (1.0 / away) * way);
      if (hit && hit->distance_m < away) continue;
    }
    const double w = std::exp(-away * away / (distance_m_ * distance_m_)) + 1e-6;
    blend.lux += w * results.reflected_lux[found->second];
    blend.error_lux += std::pow(w * results.error_lux[found->second], 2);  // independent
    blend.weight += w;
  }
  if (blend.weight > 0.0) {
    blend.lux /= blend.weight;
    blend.error_lux = std::sqrt(blend.error_lux) / blend.weight;
  }
  return blend;
}

bool ReflectedSharing::is_flat(std::size_t sensor) const {
  return std::abs(sensors_.normal[sensor].z) > 0.9;
}

double ReflectedSharing::missed_lux(bool flat, const SensorIlluminance& of_representatives,
                                    const RayVisibility& rays) const {
  std::vector<double> squares(representative_.size(), -1.0);
  parallel_for(representative_.size(), 256, [&](IndexRange range) {
    for (std::size_t r = range.begin; r < range.end; ++r) {
      if (is_flat(representative_[r]) != flat) continue;
      const Blend blend = blend_at(representative_[r], true, of_representatives, rays);
      if (!(blend.weight > 0.0)) continue;
      const double missed = blend.lux - of_representatives.reflected_lux[r];
      squares[r] = missed * missed;
    }
  });
  double sum = 0.0, count = 0.0;
  for (const double square : squares) {
    if (square >= 0.0) sum += square, count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

void ReflectedSharing::spread(const SensorIlluminance& of_representatives,
                              const RayVisibility& rays, SensorIlluminance& all) const {
  const std::array<double, 2> missed{missed_lux(false, of_representatives, rays),
                                     missed_lux(true, of_representatives, rays)};
  constexpr double k95 = 1.96;
  parallel_for(sensors_.size(), 256, [&](IndexRange range) {
    for (std::size_t s = range.begin; s < range.end; ++s) {
      const std::size_t own = place_.at(key_of(cell_of(s)));
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
