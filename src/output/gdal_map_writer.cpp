// The only file of this module that names GDAL: a library of its own, loaded when maps are first
// written.
#include <cpl_error.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/error.h"
#include "output/map_writer.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

struct CloseDataset {
  void operator()(GDALDataset* dataset) const noexcept { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, CloseDataset>;

/// Keeps GDAL from printing while it is there.
class QuietGdal {
 public:
  QuietGdal() {
    CPLPushErrorHandler(CPLQuietErrorHandler);
    GDALAllRegister();
    CPLErrorReset();
  }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
};

[[noreturn]] void fail(const fs::path& file) {
  throw ResourceError(file.string() + ": cannot be written: " + CPLGetLastErrorMsg());
}

GDALDriver& driver_named(const char* name) {
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(name);
  if (!driver) throw ResourceError(std::string("GDAL is without its driver ") + name);
  return *driver;
}

/// Without heights: those are values, or coordinates that say so.
OGRSpatialReference system_named(const std::string& crs) {
  OGRSpatialReference system;
  if (crs.empty()) return system;
  if (system.SetFromUserInput(crs.c_str()) != OGRERR_NONE) {
    throw InputError("unknown reference system " + crs);
  }
  system.StripVertical();
  system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return system;
}

OGRLinearRing ring_of(const MapLayer::Ring& points) {
  OGRLinearRing ring;
  for (const Vec3 p : points) ring.addPoint(p.x, p.y, p.z);
  ring.closeRings();
  return ring;
}

OGRMultiPolygon outline_of(const MapLayer::Feature& feature) {
  OGRMultiPolygon all;
  for (const MapLayer::Polygon& rings : feature.outline) {
    OGRPolygon polygon;
    for (const MapLayer::Ring& points : rings) {
      OGRLinearRing ring = ring_of(points);
      polygon.addRing(&ring);
    }
    all.addGeometry(&polygon);
  }
  return all;
}

class GdalMapWriter final : public MapWriter {
 public:
  void write_raster(const fs::path& file, const MapRaster& raster) const override {
    const QuietGdal quiet;
    const OGRSpatialReference system = system_named(raster.crs);
    const int columns = static_cast<int>(raster.columns), rows = static_cast<int>(raster.rows);
    char compress[] = "COMPRESS=DEFLATE", predictor[] = "PREDICTOR=3", tiled[] = "TILED=YES";
    char* options[] = {compress, predictor, tiled, nullptr};
    Dataset made(driver_named("GTiff").Create(
        file.c_str(), columns, rows, static_cast<int>(raster.bands.size()), GDT_Float32, options));
    if (!made) fail(file);
    std::array<double, 6> place = raster.to_map;
    if (made->SetGeoTransform(place.data()) != CE_None) fail(file);
    if (!raster.crs.empty() && made->SetSpatialRef(&system) != CE_None) fail(file);
    for (std::size_t b = 0; b < raster.bands.size(); ++b) {
      const MapRaster::Band& band = raster.bands[b];
      GDALRasterBand& to = *made->GetRasterBand(static_cast<int>(b) + 1);
      to.SetNoDataValue(std::nan(""));
      to.SetDescription(band.name.c_str());
      to.SetUnitType(band.unit.c_str());
      std::vector<float> values = band.values;  // GDAL takes what it could write to
      if (to.RasterIO(GF_Write, 0, 0, columns, rows, values.data(), columns, rows, GDT_Float32, 0,
                      0, nullptr) != CE_None) {
        fail(file);
      }
    }
    // What is still to be written fails without a word where the disk is full.
    CPLErrorReset();
    made.reset();
    if (CPLGetLastErrorType() >= CE_Failure) fail(file);
  }

  void write_layers(const fs::path& file, const std::string& crs,
                    const std::vector<MapLayer>& layers) const override {
    const QuietGdal quiet;
    OGRSpatialReference system = system_named(crs);
    Dataset made(driver_named("GPKG").Create(file.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    if (!made) fail(file);
    for (const MapLayer& layer : layers) {
      OGRLayer* to = made->CreateLayer(layer.name.c_str(), crs.empty() ? nullptr : &system,
                                       wkbMultiPolygon25D, nullptr);
      if (!to) fail(file);
      write_layer(*to, layer, file);
    }
    CPLErrorReset();
    made.reset();
    if (CPLGetLastErrorType() >= CE_Failure) fail(file);
  }

 private:
  static void write_layer(OGRLayer& to, const MapLayer& layer, const fs::path& file) {
    OGRFieldDefn id("object_id", OFTString), type("type", OFTString);
    if (to.CreateField(&id) != OGRERR_NONE || to.CreateField(&type) != OGRERR_NONE) fail(file);
    for (const std::string& name : layer.value_names) {
      OGRFieldDefn field(name.c_str(), OFTReal);
      if (to.CreateField(&field) != OGRERR_NONE) fail(file);
    }
    if (to.StartTransaction() != OGRERR_NONE) fail(file);
    for (const MapLayer::Feature& one : layer.features) {
      OGRFeature feature(to.GetLayerDefn());
      feature.SetField(0, one.id.c_str());
      feature.SetField(1, one.type.c_str());
      for (std::size_t k = 0; k < one.values.size(); ++k) {
        if (!std::isnan(one.values[k])) feature.SetField(static_cast<int>(k) + 2, one.values[k]);
      }
      const OGRMultiPolygon outline = outline_of(one);
      if (feature.SetGeometry(&outline) != OGRERR_NONE) fail(file);
      if (to.CreateFeature(&feature) != OGRERR_NONE) fail(file);
    }
    if (to.CommitTransaction() != OGRERR_NONE) fail(file);
  }
};

}  // namespace
}  // namespace tenku

const tenku::Plugin* tenku_plugin() {
  static const tenku::GdalMapWriter writer;
  return &writer;
}
