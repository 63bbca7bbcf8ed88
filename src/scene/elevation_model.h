/// Elevation models from raster files. GDAL stands behind, loaded at first use.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/plugin.h"
#include "core/vec3.h"

namespace tenku {

/// Heights of the ground at the centres of the pixels of a raster.
///
/// Shape    `points` [row][column], row-major, `rows * columns` of them.
/// Frame    x east (or longitude), y north (or latitude) in `crs`, z up.
/// Units    x and y those of `crs`; z metres. NaN as z where the file has no data.
struct ElevationModel {
  std::size_t rows = 0, columns = 0;
  std::string crs;  ///< `EPSG:3763`; empty if the file names none
  std::vector<Vec3> points;
};

/// Reads what GDAL can.
///
/// Threads  may be used by many at once.
class ElevationCodec : public Plugin {
 public:
  /// @param crs  if not empty and the file names another, x and y are brought into it, as good as
  ///             the transformation that PROJ finds without grids; heights stay what they are
  /// @throws InputError if the file cannot be read, has no place or more pixels than can be used
  virtual ElevationModel read(const std::filesystem::path& path, const std::string& crs) const = 0;
};

}  // namespace tenku
