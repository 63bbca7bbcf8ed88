/// The polygons of a picture, for the paper's level of detail.
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec3.h"

namespace tenku {

/// Triangles that a camera sees.
///
/// Shape    `of_sensor` [sensor]; the others [polygon].
struct SeenPolygons {
  std::vector<std::uint32_t> of_sensor;
  std::vector<Vec3> normal;    ///< unit
  std::vector<double> pixels;  ///< that it would cover, M_p / d_p^2 of the paper in pixels
};

}  // namespace tenku
