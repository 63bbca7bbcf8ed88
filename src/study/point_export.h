/// The points of a store for other programs.
#pragma once

#include <cstddef>
#include <filesystem>

#include "flythrough/point_store.h"

namespace tenku {

/// Writes all points with the light of one lighting, by the extension of `path`:
///
/// `.ply`  binary PLY: x y z, nx ny nz, red green blue, footprint_m, sun_lux, sky_lux,
///         reflected_lux, luminance_cd_m2;
/// `.glb`  glTF 2.0, one primitive of points without lighting: POSITION, NORMAL, COLOR_0;
/// `.vtp`  VTK PolyData with the values of the PLY, and `object`, as point arrays.
///
/// Colours are luminance over the store's white: sRGB codes in PLY, linear in glTF, as either
/// expects.
///
/// Frame    local east, north, up; glTF is y up by its standard: east, up, south. Metres.
/// Source   PLY: G. Turk, "The PLY polygon file format", 1994. glTF: Khronos, glTF 2.0, 3.6, 3.7.2.
/// @throws InputError     another extension, no such lighting, or a folder that does not exist
/// @throws ResourceError  if reading or writing fails
void export_points(const PointStore& store, std::size_t lighting,
                   const std::filesystem::path& path);

/// Tells before a store is read whether `export_points` knows the extension.
/// @throws InputError if not
void check_export_ending(const std::filesystem::path& path);

}  // namespace tenku
