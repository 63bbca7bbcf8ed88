/// Reading that refuses instead of mending. Private to this module.
#pragma once

#include <filesystem>

#include "scene/raw_scene.h"

namespace tenku {

/// Refuses a scene of which something was mended, left out or guessed: all findings that are
/// warnings or errors but those that are only told (an open shell, faces that coincide), and notes
/// of mending (`duplicate_vertices`, `repeated_vertex`, `zero_area_face`, `reflectance_clamped`,
/// `feet_lowered`).
/// @throws InputError  naming the kinds, how often each, and an object of it
void refuse_mended(const RawScene& raw, const std::filesystem::path& path);

}  // namespace tenku
