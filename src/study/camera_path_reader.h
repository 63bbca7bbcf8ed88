/// Camera paths from files, and over the ground of a scene.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "flythrough/camera_path.h"
#include "study/lit_scene.h"

namespace tenku {

/// Reads a path, TOML as `docs/flythrough.md` describes it.
///
/// Frame    keys in the coordinates of the scene file, as they stand in the path file.
/// @throws InputError  naming file and line: no such file, no TOML, a key that is not known (with
///                     the nearest that is), missing, of the wrong type or out of range
CameraPathRequest read_camera_path(const std::filesystem::path& path);

/// The frames in the local frame; a walk goes over the scene's ground.
/// @throws InputError as `make_camera_path`
CameraPath camera_path_in(CameraPathRequest request, const LitScene& lit);

/// Every key that may stand in a path file, as `table.key` or `key`, in the order of the
/// documentation.
std::vector<std::string> camera_path_keys();

}  // namespace tenku
