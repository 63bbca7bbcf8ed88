/// A store whose light is known in closed form.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "flythrough/chunk_cuts.h"
#include "flythrough/point_store.h"

namespace tenku::testing_support {

inline constexpr double kFloorLux = 20'000.0, kLightFloor = 0.5, kDarkFloor = 0.1;
inline constexpr double kSkyLuminance = 4'000.0, kBelow = 700.0;

/// Squares of 1 m in turn light and dark.
inline bool is_light_square(double x, double y) {
  return (static_cast<int>(std::floor(x)) + static_cast<int>(std::floor(y))) % 2 == 0;
}

/// A level floor from (-6, -2) to (6, 14) m in points 5 cm apart, evenly lit, under an even sky.
inline StoredPoints floor_points() {
  StoredPoints points;
  constexpr double kStep = 0.05;
  for (int j = 0; j < 320; ++j) {
    for (int i = 0; i < 240; ++i) {
      const double x = -6.0 + (i + 0.5) * kStep, y = -2.0 + (j + 0.5) * kStep;
      points.position.push_back({x, y, 0.0});
      points.normal.push_back({0.0, 0.0, 1.0});
      points.footprint_m.push_back(static_cast<float>(kStep));
      points.object.push_back(0);
      points.material.push_back(is_light_square(x, y) ? 0 : 1);
      points.is_edge.push_back(0);
      points.borders.emplace_back();
    }
  }
  return points.of(
      cut_by_space(points, points.size()).front());  // in the order of a gathered chunk
}

inline StoreHeader floor_header() {
  StoreHeader header;
  header.scene = "floor", header.scene_sha256 = std::string(64, '0');
  header.materials = {{"light", Rgb{kLightFloor, kLightFloor, 0.5 * kLightFloor}, {}},
                      {"dark", Rgb::grey(kDarkFloor), {}}};
  header.path.width = 64, header.path.height = 48, header.path.frames_per_s = 10.0;
  for (int k = 0; k < 6; ++k) {
    header.path.frames.push_back(
        {k / 10.0, {0.2 * k, -3.0, 3.0}, {0.2 * k, 4.0, 0.5}, Angle::degrees(60.0)});
  }
  return header;
}

inline StoreLighting even_sky(const std::string& time) {
  StoreLighting lighting;
  lighting.time = time, lighting.sky = "even";
  lighting.below_horizon = Rgb::grey(kBelow);
  lighting.sky_map = {8, 3, std::vector<Rgb>(24, Rgb::grey(kSkyLuminance))};
  return lighting;
}

/// @param frames_done  of the six, after which the store is cut off
inline void write_floor_store(const std::filesystem::path& file, std::size_t frames_done = 6) {
  PointStoreWriter store(file, floor_header());
  const StoredPoints points = floor_points();
  for (std::size_t k = 0; k < 2; ++k) store.add_lighting(even_sky(k == 0 ? "09:00" : "18:00"));
  const std::size_t chunk = store.add_points(points);
  for (std::size_t k = 0; k < 2; ++k) {
    PointLight light(points.size());
    std::fill(light.sky_lux.begin(), light.sky_lux.end(),
              static_cast<float>(kFloorLux / (k == 0 ? 1.0 : 8.0)));
    store.add_light(chunk, k, light);
  }
  if (frames_done > 0) store.end_frames(frames_done);
}

}  // namespace tenku::testing_support
