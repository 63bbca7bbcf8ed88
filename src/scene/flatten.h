/// From polygons to triangles, once.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"
#include "scene/triangle_soup.h"

namespace tenku {

/// All triangles of a scene, in the order of its surfaces.
///
/// Cost     0.1 s per million triangles; about 10 us for a polygon that is neither a triangle nor a
///          convex quadrilateral.
TriangleSoup flatten(const Scene& scene);

/// The surface of each triangle of `flatten(scene)`.
std::vector<std::uint32_t> surfaces_of_triangles(const Scene& scene);

}  // namespace tenku
