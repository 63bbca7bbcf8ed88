/// Reader of 3D Tiles.
#pragma once

#include <filesystem>

#include "core/progress.h"
#include "scene/raw_scene.h"

namespace tenku {

/// Reads the finest tiles of a `tileset.json` (explicit, implicit or external), or one `b3dm` file:
/// triangles by feature, `b3dm`, `cmpt` and glTF, also packed by Draco. A tile that is not there is
/// a finding. Coordinates about the centre of the Earth become longitude, latitude and height.
///
/// Source   OGC 22-025r4, "3D Tiles Specification" 1.1; for `b3dm` and `cmpt` OGC 18-053r2 (1.0).
/// @throws InputError  naming the file and what is wrong in it, and as `read_input_file`
RawScene read_tileset(const std::filesystem::path& path, Progress& progress);

}  // namespace tenku
