/// Where on the sides of a mesh light is gathered.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "illuminance/sensor.h"
#include "meshing/element_mesh.h"

namespace tenku {

/// The corners of elements, once for each way that surfaces face there: a corner of a room is
/// three points. Elements of one plane share theirs, so that values are continuous on it.
///
/// Points are drawn back by kDrawnBack of the way to the middle of the elements that share them,
/// off the edges where surfaces meet: there a ray would start on both.
struct SidePoints {
  static constexpr double kDrawnBack = 0.02;

  Sensors sensors;                                   ///< on the surface, not lifted
  std::vector<std::array<std::uint32_t, 3>> corner;  ///< [element side], of `sensors`
  std::vector<std::uint32_t> plane;  ///< [point], equal for points of connected elements of a plane
  std::uint32_t planes = 0;

  std::size_t size() const { return sensors.size(); }
};

SidePoints side_points(const ElementMesh& mesh);

}  // namespace tenku
