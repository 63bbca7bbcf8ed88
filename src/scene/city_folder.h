/// A folder of tiles as one city.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "scene/raw_scene.h"

namespace tenku {

/// The files of a folder and of the folders in it that `is_wanted` names, by name.
/// @throws InputError if the folder cannot be read
std::vector<std::filesystem::path> files_in(
    const std::filesystem::path& folder,
    const std::function<bool(const std::filesystem::path&)>& is_wanted);

/// The same, of tiles.
/// @throws InputError if there are none
std::vector<std::filesystem::path> tiles_in(
    const std::filesystem::path& folder,
    const std::function<bool(const std::filesystem::path&)>& is_tile);

/// Appends a tile to the tiles before it.
///
/// @param file  of the tile, for messages
/// @throws InputError if the tile has another reference system, or axes of its own
void append_tile(RawScene& city, RawScene tile, const std::filesystem::path& file);

}  // namespace tenku
