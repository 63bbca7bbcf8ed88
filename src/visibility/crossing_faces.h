/// Faces that pass through one another.
#pragma once

#include <optional>

#include "core/finding.h"
#include "scene/scene.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// Where edges of one object pass through opaque faces of another, further than the lift of rays
/// from both their ends: solids that intersect. Faces that touch, or lie in one plane, do not.
///
/// Cost     a ray an edge.
std::optional<Finding> crossing_faces(const Scene& scene, const RayVisibility& rays);

}  // namespace tenku
