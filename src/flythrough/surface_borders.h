/// Where the surface about a point ends.
#pragma once

#include <array>
#include <cstddef>

#include "flythrough/stored_points.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// The two nearest borders of the flat surface that holds the triangle: edges across which nothing
/// lies, or something that faces elsewhere or has another material.
/// @param normal  as it is stored (`as_stored_normal`), on the side that is seen
PointBorders borders_near(const RayVisibility& rays, std::uint32_t triangle, Vec3 point,
                          Vec3 normal, double footprint_m);

}  // namespace tenku
