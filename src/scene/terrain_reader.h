/// Terrain from an elevation model.
#pragma once

#include <filesystem>
#include <string>

#include "core/progress.h"
#include "scene/raw_scene.h"

namespace tenku {

/// Reads a GeoTIFF of heights as one object, two triangles between each four neighbouring pixels.
///
/// Pixels without data are holes, told as `terrain_hole`.
///
/// @param city_crs  of the city that it belongs to, into which it is brought; empty: its own
/// @param has_registry_axes  of the city: northing or latitude first where the registry says so
/// @throws InputError  if it cannot be read, or no four neighbouring pixels have heights
RawScene read_terrain(const std::filesystem::path& path, const std::string& city_crs,
                      bool has_registry_axes, Progress& progress);

}  // namespace tenku
