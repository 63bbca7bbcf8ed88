/// Values on the map, as GIS programs read them. GDAL stands behind, loaded at first use.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/plugin.h"
#include "core/vec3.h"

namespace tenku {

/// Squares of the map with values.
///
/// Shape    `values` of each band [row][column], row-major; NaN where there is none.
/// Frame    the corner (column, row) lies at x = to_map[0] + to_map[1] column + to_map[2] row,
///          y = to_map[3] + to_map[4] column + to_map[5] row; x east (or longitude), y north.
struct MapRaster {
  std::size_t rows = 0, columns = 0;
  std::array<double, 6> to_map{};
  std::string crs;  ///< `EPSG:N` or a text for PROJ; empty: none
  struct Band {
    std::string name, unit;
    std::vector<float> values;
  };
  std::vector<Band> bands;
};

/// A table of things with an outline.
///
/// Frame    x east (or longitude), y north, z up, in the layer's reference system.
struct MapLayer {
  using Ring = std::vector<Vec3>;     ///< the first point not repeated
  using Polygon = std::vector<Ring>;  ///< the outer ring first
  struct Feature {
    std::string id, type;
    std::vector<Polygon> outline;
    std::vector<double> values;  ///< as `value_names`; NaN: none
  };
  std::string name;
  std::vector<std::string> value_names;
  std::vector<Feature> features;
};

/// Writes what GDAL can. The files appear whole or not at all.
///
/// Threads  may be used by many at once.
class MapWriter : public Plugin {
 public:
  /// A GeoTIFF of 32-bit floats, deflated.
  /// @throws ResourceError if it cannot be written; InputError if `crs` is not known
  virtual void write_raster(const std::filesystem::path& file, const MapRaster& raster) const = 0;
  /// A GeoPackage of layers of multi-polygons with heights.
  /// @throws  as `write_raster`
  virtual void write_layers(const std::filesystem::path& file, const std::string& crs,
                            const std::vector<MapLayer>& layers) const = 0;
};

/// The writer, loaded at first use.
/// @throws ResourceError if it is not installed
const MapWriter& map_writer();

}  // namespace tenku
