/// Whether a camera could go its path.
#pragma once

#include <vector>

#include "core/finding.h"
#include "flythrough/camera_path.h"
#include "scene/scene.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// One finding for each thing that the eye goes through, with its time and its object:
/// `path_through_wall`. What lies between two frames is found too; panes of glass are not asked
/// for.
/// @param keys  of the path, to say between which of them; may be empty
std::vector<Finding> check_path(const CameraPath& path, const std::vector<CameraKey>& keys,
                                const Scene& scene, const RayVisibility& rays);

}  // namespace tenku
