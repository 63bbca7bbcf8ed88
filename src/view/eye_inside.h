/// Whether a camera stands where nobody can: inside a building, or under the ground.
#pragma once

#include <optional>

#include "core/finding.h"
#include "core/vec3.h"
#include "scene/scene.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// A finding if the eye sees no sky in any of 64 directions upward and level, and what is nearest
/// shows its back: the picture would be that of the inside of a solid, mostly black. Names the
/// object that most of the directions meet. A room whose faces look inward, or one with a window,
/// is no such place.
/// @param eye  local frame
std::optional<Finding> eye_inside(Vec3 eye, const Scene& scene, const RayVisibility& rays);

}  // namespace tenku
