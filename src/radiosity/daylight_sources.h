/// Sun and sky on the sides of a mesh: the light that radiosity starts from.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/finding.h"
#include "core/progress.h"
#include "illuminance/sensor.h"
#include "meshing/element_mesh.h"
#include "radiosity/kept_daylight.h"
#include "radiosity/side_points.h"

namespace tenku {

/// Direct light, through panes where there are any.
struct DaylightOnSides {
  SensorIlluminance points;        ///< [point] of the corners; nothing of it is reflected
  std::vector<double> lux;         ///< [element side], mean over it
  std::vector<double> middle_lux;  ///< [element side]
  std::uint64_t rays = 0;
  std::size_t sensors = 0, out_of_tolerance = 0;
  std::vector<Finding> findings;

  DaylightOnSides(std::size_t point_count, std::size_t sides)
      : points(point_count), lux(sides), middle_lux(sides) {}
};

/// Sensors are the corners and the middles of elements. The mean of a side is a quarter of the mean
/// of its corners and three quarters of its middle: exact for quadratic polynomials.
///
/// @param is_open  [point], whether sun or sky may reach it: others get nothing, and cost nothing
/// @param kept     of the same mesh and open points
/// @throws as `illuminate`
DaylightOnSides daylight_on_sides(const ElementMesh& mesh, const SidePoints& points,
                                  std::span<const std::uint8_t> is_open,
                                  const DaylightMethod& daylight, KeptDaylight& kept,
                                  Progress& progress);

}  // namespace tenku
