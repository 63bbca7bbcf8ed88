/// Tiles of an implicit tileset, by the availability that its subtrees tell. Private to this
/// module.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/json_source.h"

namespace tenku {

/// Place of a tile in the tree: level, x, y, z.
using TileAddress = std::array<std::uint64_t, 4>;

/// `{level}`, `{x}`, `{y}`, `{z}` put into a template.
std::string uri_of(std::string text, const TileAddress& address);

/// All tiles with contents, from the root down.
struct ImplicitTiles {
  std::vector<TileAddress> with_content;
  std::vector<std::string> missing;  ///< subtrees that are not there
};

/// @param tiling  the member `implicitTiling` of a tile
/// @param folder  of the tileset
/// @throws InputError naming the subtree if it is damaged, or if it tells of more than 10 million
///         tiles
///
/// Source   OGC 22-025r4, "3D Tiles Specification" 1.1, section on implicit tiling.
ImplicitTiles implicit_tiles(JsonElement tiling, const std::filesystem::path& folder,
                             const JsonSource& source);

/// Those that no finer one takes the place of.
std::vector<TileAddress> finest(const std::vector<TileAddress>& tiles);

}  // namespace tenku
