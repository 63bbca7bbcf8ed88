/// Places on triangles.
#pragma once

#include "core/vec3.h"

namespace tenku {

/// The point of a triangle closest to `p`; a triangle without area is its longest edge.
///
/// Source   C. Ericson, "Real-Time Collision Detection", 2005, section 5.1.5: the regions of the
///          plane in barycentric terms.
Vec3 closest_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c);

}  // namespace tenku
