// The only file that names GDAL: a library of its own, loaded when terrain is first read.
#include <cpl_error.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "core/error.h"
#include "scene/elevation_model.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

constexpr double kNoData = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostPixels = 20'000'000;  // 32 bytes each while they are thinned

struct CloseDataset {
  void operator()(GDALDataset* dataset) const noexcept { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, CloseDataset>;

/// Keeps GDAL from printing while it is there.
class QuietGdal {
 public:
  QuietGdal() { CPLPushErrorHandler(CPLQuietErrorHandler); }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
};

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
  throw InputError(path.string() + ": " + what);
}

Dataset open(const fs::path& path) {
  GDALAllRegister();
  // Without it heights of a GeoTIFF 1.0 lose their reference system, and with it their unit.
  CPLSetThreadLocalConfigOption("GTIFF_REPORT_COMPD_CS", "YES");
  const std::array<const char*, 2> drivers{"GTiff", nullptr};
  Dataset file(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers.data()));
  if (!file) refuse(path, std::string("cannot be read as a GeoTIFF: ") + CPLGetLastErrorMsg());
  if (file->GetRasterCount() != 1) refuse(path, "an elevation model has one band of heights");
  return file;
}

std::string code_of(const OGRSpatialReference& system) {
  const char* authority = system.GetAuthorityName(nullptr);
  const char* code = system.GetAuthorityCode(nullptr);
  return authority && code ? std::string(authority) + ":" + code : std::string();
}

/// A pair of systems often has no code where that of the map has one.
std::string name_of(OGRSpatialReference system) {
  std::string name = code_of(system);
  if (!name.empty()) return name;
  system.StripVertical();
  return code_of(system);
}

/// Metres per unit of height: of the band, or of a vertical reference system.
double metres_per_height_unit(GDALRasterBand& band, const OGRSpatialReference* system,
                              const fs::path& path) {
  const std::string unit = band.GetUnitType();
  if (unit == "ft" || unit == "foot") return 0.3048;
  if (unit == "us-ft" || unit == "US survey foot" || unit == "ftUS") return 1200.0 / 3937.0;
  if (unit == "m" || unit == "metre" || unit == "meter") return 1.0;
  if (!unit.empty()) refuse(path, "heights in '" + unit + "'; known are metres and feet");
  return system && system->IsVertical() ? system->GetTargetLinearUnits("VERT_CS") : 1.0;
}

std::vector<double> heights(GDALRasterBand& band, double unit, const fs::path& path) {
  const int columns = band.GetXSize(), rows = band.GetYSize();
  std::vector<double> z(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  if (band.RasterIO(GF_Read, 0, 0, columns, rows, z.data(), columns, rows, GDT_Float64, 0, 0,
                    nullptr) != CE_None) {
    refuse(path, std::string("cannot be read: ") + CPLGetLastErrorMsg());
  }
  int has_no_data = 0;
  double no_data = band.GetNoDataValue(&has_no_data);
  // What a band of floats marks with a double is the float nearest to it.
  if (band.GetRasterDataType() == GDT_Float32) {
    no_data = static_cast<double>(static_cast<float>(no_data));
  }
  const double scale = band.GetScale() * unit, offset = band.GetOffset() * unit;
  for (double& height : z) {
    const bool is_missing = !std::isfinite(height) || (has_no_data && height == no_data);
    height = is_missing ? kNoData : scale * height + offset;
  }
  return z;
}

/// Centres of pixels: what a geotransform places are their corners.
void place(GDALDataset& file, ElevationModel& model, const std::vector<double>& z,
           const fs::path& path) {
  std::array<double, 6> t{};
  if (file.GetGeoTransform(t.data()) != CE_None)
    refuse(path, "it does not say where its pixels lie");
  model.points.reserve(z.size());
  for (std::size_t k = 0; k < z.size(); ++k) {
    const double column = static_cast<double>(k % model.columns) + 0.5;
    const double row = static_cast<double>(k / model.columns) + 0.5;
    model.points.push_back(
        {t[0] + t[1] * column + t[2] * row, t[3] + t[4] * column + t[5] * row, z[k]});
  }
}

void transform(ElevationModel& model, OGRSpatialReference from, const std::string& crs,
               const fs::path& path) {
  OGRSpatialReference to;
  if (to.SetFromUserInput(crs.c_str()) != OGRERR_NONE) refuse(path, "unknown system " + crs);
  for (OGRSpatialReference* system : {&from, &to}) {
    system->StripVertical();
    system->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  }
  if (from.IsSame(&to)) return;
  const std::unique_ptr<OGRCoordinateTransformation> change(
      OGRCreateCoordinateTransformation(&from, &to));
  if (!change) refuse(path, "there is no way from its reference system to " + crs);
  for (Vec3& p : model.points) {
    if (change->Transform(1, &p.x, &p.y)) continue;
    refuse(path, "a point of it cannot be brought into " + crs);
  }
}

class GdalCodec final : public ElevationCodec {
 public:
  ElevationModel read(const fs::path& path, const std::string& crs) const override {
    const QuietGdal quiet;
    const Dataset file = open(path);
    GDALRasterBand& band = *file->GetRasterBand(1);
    ElevationModel model;
    model.rows = static_cast<std::size_t>(band.GetYSize());
    model.columns = static_cast<std::size_t>(band.GetXSize());
    if (model.rows > kMostPixels / model.columns) {
      refuse(path, "more than 20 million pixels; cut out what can be seen, or take larger pixels");
    }
    const OGRSpatialReference* system = file->GetSpatialRef();
    if (system) model.crs = name_of(*system);
    if (system && model.crs.empty()) refuse(path, "its reference system has no EPSG code");
    place(*file, model, heights(band, metres_per_height_unit(band, system, path), path), path);
    if (system && !crs.empty()) transform(model, *system, crs, path);
    return model;
  }
};

}  // namespace
}  // namespace tenku

const tenku::Plugin* tenku_plugin() {
  static const tenku::GdalCodec codec;
  return &codec;
}
