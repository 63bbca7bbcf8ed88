// Terrain from GeoTIFF.
#include <gtest/gtest.h>

#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/error.h"
#include "scene/georeference.h"
#include "tests/scene/citygml_texts.h"
#include "tests/scene/elevation_files.h"

namespace tenku {
namespace {

/// Easting, northing, height of the file's pixel centres, as read, by northing then easting.
std::vector<Vec3> map_points(const Scene& scene) {
  std::vector<Vec3> points;
  for (const Vec3 v : scene.vertices) points.push_back(scene.map_frame.to_file(v));
  return points;
}

void expect_point(const std::vector<Vec3>& points, const Vec3 wanted, double tolerance_m) {
  const bool is_there = std::any_of(points.begin(), points.end(), [&](const Vec3 p) {
    return length(p - wanted) <= tolerance_m;
  });
  EXPECT_TRUE(is_there) << wanted.x << ", " << wanted.y << ", " << wanted.z;
}

const std::vector<float> kHeights{1, 2, 3, 4, 5, 6.5F};

TEST(Terrain, HeightsStandAtTheCentresOfPixels) {
  const Scene scene = read_text("dem.tif", elevation_model(kHeights, 28992, {100000, 450000}));
  EXPECT_EQ(scene.format, "GeoTIFF");
  EXPECT_EQ(scene.georeference->crs, "EPSG:28992");
  EXPECT_EQ(scene.surfaces.size(), 4U);
  const auto points = map_points(scene);
  ASSERT_EQ(points.size(), 6U);
  expect_point(points, {100005, 449995, 1}, 1e-6);
  expect_point(points, {100025, 449995, 3}, 1e-6);
  expect_point(points, {100005, 449985, 4}, 1e-6);
  expect_point(points, {100025, 449985, 6.5}, 1e-6);
  for (std::size_t s = 0; s < 4; ++s) EXPECT_GT(area_vector(scene, s).z, 0.0);
}

TEST(Terrain, PixelsWithoutDataAreHolesThatAreTold) {
  const Scene scene =
      read_text("dem.tif", elevation_model({-9999, 2, 3, 4, 5, 6}, 28992, {100000, 450000}));
  EXPECT_EQ(scene.surfaces.size(), 2U);
  EXPECT_EQ(count_of(scene, "terrain_hole"), 1U);
}

TEST(Terrain, HeightsInFeetBecomeMetres) {
  // 9002 is the foot of EPSG, 0.3048 m; 9003 that of the US survey, 1200/3937 m.
  for (const auto& [unit, metres] : {std::pair{9002, 0.3048}, std::pair{9003, 1200.0 / 3937.0}}) {
    const Scene scene =
        read_text("dem.tif", elevation_model({1000, 2000, 3000, 1000, 2000, 3000}, 28992,
                                             {100000, 450000}, static_cast<std::uint16_t>(unit)));
    expect_point(map_points(scene), {100025, 449995, 3000.0 * metres}, 1e-6);
  }
}

TEST(Terrain, ACityInAFolderIsSetOnTheTerrainBesideIt) {
  const TemporaryFolder folder;
  folder.write("city.gml", city_model(box_building("house")));
  folder.write("a.tif", elevation_model(kHeights, 28992, {99990, 450010}));
  const Scene scene = read(folder.path());
  ASSERT_EQ(scene.objects.size(), 2U);  // no ground of ours
  EXPECT_EQ(scene.objects[1].type, "TINRelief");
  EXPECT_TRUE(scene.has_terrain);
  expect_point(map_points(scene), {99995, 450005, 1}, 1e-5);
}

TEST(Terrain, AnotherReferenceSystemIsBroughtIntoThatOfTheCity) {
  // Amersfoort's fundamental point, (155000, 463000) in EPSG:28992, as the RDNAPTRANS documents
  // have it in ETRS89; UTM by GeographicLib; a datum shift without grids is good to a metre.
  int zone = 0;
  bool is_north = false;
  double easting = 0.0, northing = 0.0;
  GeographicLib::UTMUPS::Forward(52.155172897, 5.387203657, zone, is_north, easting, northing, 31);
  const TemporaryFolder folder;
  folder.write("city.gml", city_model(box_building("house")));
  folder.write("a.tif", elevation_model(kHeights, 25831, {easting - 5, northing + 5}));
  // Lower by the curvature of the Earth, 0.87 d^2 / 2 R at the distance from the house.
  const double east = 155000 - 100004, north = 463000 - 450003;
  const double lower = 0.87 * (east * east + north * north) / (2.0 * 6371008.8);
  expect_point(map_points(read(folder.path())), {155000, 463000, 1 - lower}, 1.0);
}

// Size, scale and corner are the file's tags 256, 257, 33550 and 33922; heights by inflating the
// strips and summing the differences along the rows (predictor 2) in a few lines of Python.
TEST(Terrain, BilbaosHillsAreRead) {
  const auto data = data_folder();
  if (!data) GTEST_SKIP() << "TENKU_DATA is not set";
  const Scene scene = read(*data / "terrain" / "bilbao_DEM.tif");
  EXPECT_EQ(scene.georeference->crs, "EPSG:25830");
  EXPECT_EQ(scene.vertices.size(), 680U * 680U);
  const auto at = [](double row, double column, double height) {
    return Vec3{499400.0 + 5.001238375576373 * (column + 0.5),
                4797200.0 - 4.99921326714487 * (row + 0.5), height};
  };
  const auto points = map_points(scene);
  expect_point(points, at(0, 0, 6), 1e-6);
  expect_point(points, at(100, 200, 62), 1e-6);
  expect_point(points, at(340, 340, 0), 1e-6);
  expect_point(points, at(679, 679, 9), 1e-6);
  EXPECT_EQ(scene.extent.min.z, -2.0);
  EXPECT_EQ(scene.extent.max.z, 103.0);
  EXPECT_NEAR(scene.extent.min.x, 499400.0 + 5.001238375576373 / 2.0, 1e-6);
  EXPECT_NEAR(scene.extent.max.y, 4797200.0 - 4.99921326714487 / 2.0, 1e-6);
}

TEST(Terrain, AFileWithoutAReferenceSystemIsToldWhereItIsGuessed) {
  const TemporaryFolder folder;
  folder.write("city.gml", city_model(box_building("house")));
  folder.write("a.tif", elevation_model(kHeights, 0, {99990, 450010}));
  const Scene scene = read(folder.path());
  EXPECT_EQ(count_of(scene, "terrain_without_crs"), 1U);
  expect_point(map_points(scene), {99995, 450005, 1}, 1e-5);
}

TEST(Terrain, BrokenFilesAreRefused) {
  const std::string whole = elevation_model(kHeights, 28992, {100000, 450000});
  for (const std::size_t bytes : {0, 8, 100, 200}) {
    EXPECT_THROW(read_text("dem.tif", whole.substr(0, bytes)), InputError) << bytes;
  }
  EXPECT_THROW(read_text("dem.tif", whole.substr(0, whole.size() - 4)), InputError);
}

}  // namespace
}  // namespace tenku
