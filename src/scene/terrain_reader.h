/// Terrain from an elevation model.
#pragma once

#include <filesystem>
#include <string>

#include "core/progress.h"
#include "scene/elevation_model.h"
#include "scene/raw_scene.h"

namespace tenku {

/// Reads a GeoTIFF of heights with two rows and columns or more.
/// @param crs  as `ElevationCodec::read`
/// @throws InputError  as that
ElevationModel read_elevation_model(const std::filesystem::path& path, const std::string& crs);

/// Reads a GeoTIFF of heights as one object, two triangles between each four neighbouring pixels.
///
/// Pixels without data are holes, told as `terrain_hole`.
///
/// @param crs  into which it is brought; empty: its own
/// @throws InputError  if it cannot be read, or has more than 4 million pixels
RawScene read_terrain(const std::filesystem::path& path, const std::string& crs,
                      Progress& progress);

}  // namespace tenku
