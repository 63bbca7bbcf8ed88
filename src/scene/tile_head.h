/// What a tile of a city tells before its surfaces are read. Private to this module.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/extent.h"
#include "core/progress.h"

namespace tenku {

struct TileHead {
  std::optional<Extent> box;  ///< in the coordinates of the file; nothing if it does not tell
  std::string crs;            ///< as the file says; empty if it says none
  bool has_registry_axes = false;
};

/// Of CityJSON the extent of all vertices (of CityJSONSeq, and where there are templates, what the
/// metadata say); of CityGML the envelope of the model, for which only its beginning is read.
/// What cannot be read tells nothing here: it is refused when it is read as a scene.
TileHead head_of_cityjson(const std::filesystem::path& path);
TileHead head_of_citygml(const std::filesystem::path& path, Progress& progress);

}  // namespace tenku
