/// Sensors spread over the surfaces of a scene, and the mesh that shows their values.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "illuminance/sensor.h"
#include "scene/triangle_soup.h"

namespace tenku {

/// Sensors on triangles, with the finer triangles between them.
///
/// A triangle larger than the spacing is divided evenly, with a sensor at every corner of the
/// parts; smaller ones have one sensor, in the middle of the first of those that face the same way
/// in the same cube of that size. Sensors at corners are drawn in a little, off the walls that may
/// stand there.
/// Shape    `corner_sensor` and `corner_point` are [part][3]; `triangle` is [part], into the soup.
struct SensorGrid {
  Sensors sensors;
  std::vector<double> area_m2;    ///< [sensor], what it stands for
  std::vector<SurfaceType> type;  ///< [sensor]
  std::vector<std::array<std::uint32_t, 3>> corner_sensor;
  std::vector<std::array<Vec3, 3>> corner_point;
  std::vector<std::uint32_t> triangle;
  std::unordered_map<std::uint64_t, std::uint32_t> shared;  ///< cube and direction -> sensor
};

/// Upright over the ground, with sides to east and north; in the local frame.
struct GroundSquare {
  double x = 0.0, y = 0.0;  ///< of its middle
  double half_m = 0.0;
};

/// Adds sensors on the front sides of the chosen triangles.
/// @param spacing_m  largest distance between neighbours, metres
/// @param within     seen from above: only what lies in it is covered; null: all
/// @throws InputError if the spacing is not positive, or there would be over 50 million sensors
void append_sensors(SensorGrid& grid, const TriangleSoup& soup,
                    std::span<const std::uint32_t> triangles, double spacing_m,
                    const GroundSquare* within = nullptr);

}  // namespace tenku
