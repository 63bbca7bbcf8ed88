// Results as maps, read back by GDAL itself.
#include <cpl_conv.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <array>
#include <cmath>
#include <memory>

#include "cli/lit_scene_files.h"
#include "support/run_program.h"

namespace tenku {
namespace {

using namespace testing_support;

/// A cube of 10 m in an open field; RD New, whose grid north is 1.0 degrees off there.
const char* const kCube =
    R"({"type":"CityJSON","version":"2.0","metadata":{"referenceSystem":)"
    R"("https://www.opengis.net/def/crs/EPSG/0/7415"},"transform":{"scale":[1,1,1],)"
    R"("translate":[85000,447000,0]},"CityObjects":{"cube":{"type":"Building","geometry":)"
    R"([{"type":"Solid","lod":"2.2","boundaries":[[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],)"
    R"([[2,3,7,6]],[[3,0,4,7]]]]}]},"field":{"type":"TINRelief","geometry":[{"type":)"
    R"("CompositeSurface","lod":"1","boundaries":[[[8,9,10]],[[8,10,11]]]}]}},"vertices":[[0,0,0],)"
    R"([10,0,0],[10,10,0],[0,10,0],[0,0,10],[10,0,10],[10,10,10],[0,10,10],[-60,-40,0],[70,-40,0],)"
    R"([70,50,0],[-60,50,0]]})";

const std::string kSouthernSun =
    " --sun-altitude 45 --sun-azimuth 180 --sky uniform --sky-illuminance 10000 "
    "--sun-illuminance 60000 --bounces 0 --tolerance 1 --spacing 2 ";

struct CloseDataset {
  void operator()(GDALDataset* dataset) const noexcept { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, CloseDataset>;

Dataset opened(const std::filesystem::path& file, unsigned kind) {
  GDALAllRegister();
  return Dataset(GDALDataset::Open(file.c_str(), kind | GDAL_OF_READONLY));
}

/// Values of all bands at a place of the map.
std::array<float, 6> values_at(GDALDataset& file, double x, double y) {
  std::array<double, 6> to_map{}, to_pixel{};
  EXPECT_EQ(file.GetGeoTransform(to_map.data()), CE_None);
  EXPECT_TRUE(GDALInvGeoTransform(to_map.data(), to_pixel.data()));
  const int column = static_cast<int>(to_pixel[0] + to_pixel[1] * x + to_pixel[2] * y);
  const int row = static_cast<int>(to_pixel[3] + to_pixel[4] * x + to_pixel[5] * y);
  std::array<float, 6> values{};
  for (int b = 0; b < 6; ++b) {
    EXPECT_EQ(file.GetRasterBand(b + 1)->RasterIO(GF_Read, column, row, 1, 1,
                                                  &values[static_cast<std::size_t>(b)], 1, 1,
                                                  GDT_Float32, 0, 0, nullptr),
              CE_None);
  }
  return values;
}

TEST(MapResults, RastersLieWhereTheCityLies) {
  const auto folder = test_folder();
  write_text(folder / "cube.city.json", kCube);
  const auto run = run_tenku(
      "illuminance cube.city.json --grid ground,roofs" + kSouthernSun + "--out lux.tif", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Dataset file = opened(folder / "lux.tif", GDAL_OF_RASTER);
  ASSERT_TRUE(file);
  ASSERT_EQ(file->GetRasterCount(), 6);
  const std::array<const char*, 6> names{"sun_lux",   "sky_lux",   "reflected_lux",
                                         "total_lux", "error_lux", "sky_view"};
  for (int b = 0; b < 6; ++b) {
    EXPECT_STREQ(file->GetRasterBand(b + 1)->GetDescription(), names[static_cast<std::size_t>(b)]);
  }
  EXPECT_STREQ(file->GetRasterBand(4)->GetUnitType(), "lx");
  ASSERT_NE(file->GetSpatialRef(), nullptr);
  EXPECT_STREQ(file->GetSpatialRef()->GetAuthorityCode(nullptr), "28992");
  const double sun = 60000.0 * std::sqrt(0.5);
  // On the roof; before the southern wall; 5 m behind the northern one, in its shadow of 10 m;
  // 15 m behind it, beyond. A map upside down would have the last two before the wall.
  EXPECT_NEAR(values_at(*file, 85005, 447005)[0], sun, 1.0);
  EXPECT_NEAR(values_at(*file, 85005, 447005)[5], 1.0, 1e-3);
  EXPECT_NEAR(values_at(*file, 85005, 446995)[0], sun, 1.0);
  EXPECT_EQ(values_at(*file, 85005, 447015)[0], 0.0F);
  EXPECT_NEAR(values_at(*file, 85005, 447026)[0], sun, 1.0);
  EXPECT_NEAR(values_at(*file, 84990, 447015)[0], sun, 1.0);
  // Sun and sky make the total; before the middle of a wall less than all of the sky is seen.
  const auto near_wall = values_at(*file, 85012, 447005);
  EXPECT_NEAR(near_wall[3], near_wall[0] + near_wall[1] + near_wall[2], 0.02F);
  EXPECT_LT(near_wall[5], 0.85F);
  EXPECT_GT(near_wall[5], 0.5F);
  // The corners of the map lie beyond the field, as it is turned against the map's squares.
  std::size_t none = 0;
  const int columns = file->GetRasterXSize(), rows = file->GetRasterYSize();
  std::vector<float> all(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  ASSERT_EQ(file->GetRasterBand(4)->RasterIO(GF_Read, 0, 0, columns, rows, all.data(), columns,
                                             rows, GDT_Float32, 0, 0, nullptr),
            CE_None);
  for (const float v : all) none += std::isnan(v) ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(all.size() - none) * 4.0, 130.0 * 90.0, 250.0);
  EXPECT_GT(none, 0u);
}

TEST(MapResults, GeoPackagesHaveSurfacesAndBuildings) {
  const auto folder = test_folder();
  write_text(folder / "cube.city.json", kCube);
  const auto run = run_tenku(
      "illuminance cube.city.json --grid roofs,walls" + kSouthernSun + "--out lux.gpkg", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Dataset file = opened(folder / "lux.gpkg", GDAL_OF_VECTOR);
  ASSERT_TRUE(file);
  OGRLayer* buildings = file->GetLayerByName("buildings");
  OGRLayer* surfaces = file->GetLayerByName("surfaces");
  ASSERT_TRUE(buildings && surfaces);
  EXPECT_STREQ(buildings->GetSpatialRef()->GetAuthorityCode(nullptr), "28992");
  ASSERT_EQ(buildings->GetFeatureCount(), 1);
  EXPECT_EQ(surfaces->GetFeatureCount(), 5);
  const std::unique_ptr<OGRFeature> cube(buildings->GetNextFeature());
  EXPECT_STREQ(cube->GetFieldAsString("object_id"), "cube");
  EXPECT_STREQ(cube->GetFieldAsString("type"), "Building");
  EXPECT_NEAR(cube->GetFieldAsDouble("sky_view"), (1.0 + 4 * 0.5) / 5.0, 0.011);
  OGREnvelope box;
  cube->GetGeometryRef()->getEnvelope(&box);
  EXPECT_NEAR(box.MinX, 85000.0, 1e-6);
  EXPECT_NEAR(box.MaxX, 85010.0, 1e-6);
  EXPECT_NEAR(box.MinY, 447000.0, 1e-6);
  EXPECT_NEAR(box.MaxY, 447010.0, 1e-6);
  double highest = 0.0;
  while (const std::unique_ptr<OGRFeature> one{surfaces->GetNextFeature()}) {
    const bool is_roof = std::string(one->GetFieldAsString("type")) == "roof";
    EXPECT_NEAR(one->GetFieldAsDouble("sky_view"), is_roof ? 1.0 : 0.5, 0.011);
    OGREnvelope3D around;
    one->GetGeometryRef()->getEnvelope(&around);
    highest = std::max(highest, around.MaxZ);
  }
  EXPECT_NEAR(highest, 10.0, 1e-6);
}

TEST(MapResults, NeedAGridAndAFolder) {
  const auto folder = test_folder();
  write_text(folder / "cube.city.json", kCube);
  write_text(folder / "s.pts", "85000 447000 20 0 0 1\n");
  for (const char* out : {"o.tif", "o.gpkg", "absent/o.tif"}) {
    const auto run = run_tenku(
        "illuminance cube.city.json --sensors s.pts --sky uniform "
        "--sky-illuminance 10000 --sun-illuminance 0 --out " +
            std::string(out),
        folder);
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / out));
  }
}

}  // namespace
}  // namespace tenku
