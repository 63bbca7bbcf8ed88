/// The two engines on the same points and directions, and where they differ.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "illuminance/sensor.h"
#include "support/test_scene.h"
#include "visibility/ray_visibility.h"
#include "visibility/shadow_maps.h"

namespace tenku::testing_support {

/// Directions spread evenly over the vault, each for an equal solid angle, on a spiral.
inline std::vector<Vec3> even_directions(int count) {
  std::vector<Vec3> directions;
  const double golden = kPi * (3.0 - std::sqrt(5.0));
  for (int k = 0; k < count; ++k) {
    const double z = (k + 0.5) / count, level = std::sqrt(1.0 - z * z);
    directions.push_back({level * std::cos(golden * k), level * std::sin(golden * k), z});
  }
  return directions;
}

/// What was found between the engines.
struct EngineDifference {
  double mean = 0.0;  ///< of the sensors' illuminances, absolute, by the unobstructed one
  double signed_mean = 0.0;
  double worst_sensor = 0.0;
  double pair_mean = 0.0;           ///< of the visible fractions in front of the sensors, absolute
  std::size_t pairs = 0;            ///< in front of the sensors
  std::size_t worst_pairs = 0;      ///< the 0.1 % that differ most
  std::size_t worst_explained = 0;  ///< of them, those with an outline within two texels
};

/// Whether the light meets different objects first, up to two texels about its way to a point of a
/// surface; an object that only hides what is hidden anyhow counts, as maps know nothing behind it.
inline bool is_near_outline(const RayVisibility& rays, Vec3 point, Vec3 normal, Vec3 direction,
                            ShadowMaps::Texel texel) {
  const double level = std::hypot(direction.x, direction.y);
  const Vec3 u = level > 1e-9 ? Vec3{-direction.y / level, direction.x / level, 0} : Vec3{1, 0, 0};
  const Vec3 v = cross(direction, u);
  constexpr double kFar = 4000.0;  // m, outside of every scene here
  std::set<std::uint32_t> objects;
  for (int i = -4; i <= 4; ++i) {
    for (int j = -4; j <= 4; ++j) {
      const Vec3 across = 0.5 * i * texel.width_m * u + 0.5 * j * texel.height_m * v;
      const double along = -dot(normal, across) / dot(normal, direction);
      const Vec3 from = point + across + (along + kFar) * direction;
      const auto hit = rays.first_hit(from, -direction);
      objects.insert(hit ? rays.soup().object[hit->triangle] : MeshAdjacency::kNone);
    }
  }
  return objects.size() > 1;
}

/// Under a uniform sky in as many elements as there are directions.
inline EngineDifference compare_engines(const RayVisibility& rays, const ShadowMaps& maps,
                                        const Sensors& sensors,
                                        const std::vector<Vec3>& directions) {
  struct Pair {
    double difference;
    std::size_t sensor, direction;
  };
  EngineDifference result;
  std::vector<Pair> pairs;
  std::vector<double> sum(sensors.size());
  std::vector<float> by_rays(sensors.size()), by_maps(sensors.size());
  for (std::size_t d = 0; d < directions.size(); ++d) {
    rays.transmission_from(directions[d], sensors.position, sensors.normal, by_rays);
    maps.transmission_from(directions[d], sensors.position, sensors.normal, by_maps);
    for (std::size_t s = 0; s < sensors.size(); ++s) {
      const double cosine = dot(sensors.normal[s], directions[d]);
      if (cosine <= 0.0) continue;
      const double difference = static_cast<double>(by_maps[s]) - by_rays[s];
      pairs.push_back({difference, s, d});
      sum[s] += 2.0 / static_cast<double>(directions.size()) * cosine * difference;
      result.pair_mean += std::abs(difference);
    }
  }
  for (const double one : sum) {
    result.mean += std::abs(one) / static_cast<double>(sum.size());
    result.signed_mean += one / static_cast<double>(sum.size());
    result.worst_sensor = std::max(result.worst_sensor, std::abs(one));
  }
  result.pairs = pairs.size();
  result.pair_mean /= static_cast<double>(pairs.size());
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::abs(a.difference) > std::abs(b.difference);
  });
  pairs.resize(std::max<std::size_t>(1, pairs.size() / 1000));
  while (!pairs.empty() && pairs.back().difference == 0.0) pairs.pop_back();
  result.worst_pairs = pairs.size();
  for (const Pair& p : pairs) {
    const Vec3 toward = directions[p.direction];
    const auto texel = maps.texel(toward, sensors.position);
    const bool found =
        is_near_outline(rays, sensors.position[p.sensor], sensors.normal[p.sensor], toward, texel);
    result.worst_explained += found;
    if (!found) {
      const Vec3 at = sensors.position[p.sensor], n = sensors.normal[p.sensor];
      std::printf(
          "unexplained: (%.3f %.3f %.3f) normal (%.2f %.2f %.2f) toward (%.3f %.3f %.3f) "
          "texel %.3f x %.3f m: %.3f\n",
          at.x, at.y, at.z, n.x, n.y, n.z, toward.x, toward.y, toward.z, texel.width_m,
          texel.height_m, p.difference);
    }
  }
  return result;
}

inline void print(const std::string& what, const EngineDifference& d) {
  std::printf(
      "[ MEASURED ] %s: sensors differ by %.4f %% of the open sky in the mean (signed "
      "%.4f %%), %.3f %% at worst; pairs by %.3f %%; %zu of the worst %zu of %zu pairs lie "
      "within two texels of an outline\n",
      what.c_str(), 100 * d.mean, 100 * d.signed_mean, 100 * d.worst_sensor, 100 * d.pair_mean,
      d.worst_explained, d.worst_pairs, d.pairs);
}

/// Prints how the engines differ, and fails beyond what maps are allowed.
inline EngineDifference expect_engines_alike(const std::string& what, const RayVisibility& rays,
                                             const ShadowMaps& maps, const Sensors& sensors,
                                             int directions) {
  const EngineDifference found = compare_engines(rays, maps, sensors, even_directions(directions));
  print(what, found);
  EXPECT_LE(found.mean, 0.005) << what;
  // Errors at outlines go either way: no systematic light or shadow beyond a fifth of the above.
  EXPECT_LE(std::abs(found.signed_mean), 0.001) << what;
  EXPECT_EQ(found.worst_explained, found.worst_pairs) << what;
  return found;
}

}  // namespace tenku::testing_support
