// Cities set on elevation models, and what lies around them.
#include <gtest/gtest.h>

#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "scene/ground_heights.h"
#include "tests/scene/citygml_texts.h"
#include "tests/scene/elevation_files.h"

namespace tenku {
namespace {

/// Boxes of 10 by 10 by 6 m on the ground at `z`, as OBJ in EPSG:28992, one building each.
std::string boxes(const std::vector<Vec3>& corners) {
  std::string text;
  std::size_t first = 1;
  for (std::size_t b = 0; b < corners.size(); ++b, first += 8) {
    text += "o house" + std::to_string(b) + "\n";
    for (int k = 0; k < 8; ++k) {
      const int x = (k == 1 || k == 2 || k == 5 || k == 6) ? 10 : 0, y = k % 4 >= 2 ? 10 : 0;
      text += "v " + std::to_string(corners[b].x + x) + " " + std::to_string(corners[b].y + y) +
              " " + std::to_string(corners[b].z + (k < 4 ? 0 : 6)) + "\n";
    }
    for (const std::array<std::size_t, 4>& f : {std::array<std::size_t, 4>{0, 3, 2, 1},
                                                {4, 5, 6, 7},
                                                {0, 1, 5, 4},
                                                {1, 2, 6, 5},
                                                {2, 3, 7, 6},
                                                {3, 0, 4, 7}}) {
      text += "f";
      for (const std::size_t k : f) text += " " + std::to_string(first + k);
      text += "\n";
    }
  }
  return text;
}

constexpr double kEast = 100000.0, kNorth = 450000.0;

/// Pixels of `pixel` m about (kEast, kNorth), their heights by the place of their middles.
template <class Height>
std::string terrain_about(int side, double pixel, const Height& height) {
  Raster raster{kEast - 0.5 * side * pixel, kNorth + 0.5 * side * pixel};
  raster.columns = raster.rows = static_cast<std::uint16_t>(side);
  raster.pixel = pixel;
  std::vector<float> z;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      z.push_back(static_cast<float>(
          height(raster.west + (column + 0.5) * pixel, raster.north - (row + 0.5) * pixel)));
    }
  }
  return elevation_model(z, 28992, raster);
}

double slope(double x, double) { return 20.0 + 0.1 * (x - kEast); }

struct Made {
  Scene scene;
  std::vector<double> lowest, highest;  // [house], m above the datum
};

Made set_down(const std::vector<Vec3>& corners, const std::string& terrain,
              OnTerrain how = OnTerrain::Auto) {
  const TemporaryFolder folder;
  ReadOptions options;
  options.crs = "EPSG:28992";
  options.up = UpAxis::Z;
  options.terrain = {folder.write("dem.tif", terrain)};
  options.on_terrain = how;
  Made made;
  made.scene = read(folder.write("city.obj", boxes(corners)), options);
  made.lowest.assign(corners.size(), 1e9);
  made.highest.assign(corners.size(), -1e9);
  const Surfaces& surfaces = made.scene.surfaces;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const std::uint32_t object = surfaces.object[s];
    if (object >= corners.size()) continue;
    for (const std::uint32_t v : surfaces.outer_ring(s)) {
      const double z = made.scene.map_frame.to_file(made.scene.vertices[v]).z;
      made.lowest[object] = std::min(made.lowest[object], z);
      made.highest[object] = std::max(made.highest[object], z);
    }
  }
  return made;
}

const std::vector<Vec3> kLevel{
    {kEast - 60, kNorth, 0}, {kEast, kNorth, 0}, {kEast + 60, kNorth, 0}};

TEST(OnTerrain, BuildingsAtOneHeightAreMovedOntoASlope) {
  const Made made = set_down(kLevel, terrain_about(40, 10.0, slope));
  EXPECT_EQ(count_of(made.scene, "set_on_terrain"), 3U);
  for (std::size_t b = 0; b < 3; ++b) {
    // The lowest terrain is that under the western wall; the eastern one is a metre in it.
    const double west = slope(kLevel[b].x, 0.0);
    EXPECT_NEAR(made.lowest[b], west, 1e-4);
    EXPECT_NEAR(made.highest[b], west + 6.0, 1e-4);
  }
  EXPECT_EQ(count_of(made.scene, "floating_building"), 0U);
  EXPECT_EQ(count_of(made.scene, "ground_added"), 0U);
}

TEST(OnTerrain, KeptBuildingsAreToldWhereTheyFloatOrLieBelow) {
  std::vector<Vec3> corners = kLevel;
  corners[1].z = slope(corners[1].x, 0.0);
  corners[2].z = 60.0;
  const Made made = set_down(corners, terrain_about(40, 10.0, slope), OnTerrain::Keep);
  EXPECT_EQ(count_of(made.scene, "buried_building"), 1U);
  EXPECT_EQ(count_of(made.scene, "floating_building"), 1U);
  EXPECT_NEAR(made.lowest[2], 60.0, 1e-6);
}

TEST(OnTerrain, FeetThatStandAboveASlopeReachDownToIt) {
  // At the height of the terrain under their eastern, higher edge.
  std::vector<Vec3> corners = kLevel;
  for (Vec3& c : corners) c.z = slope(c.x + 10.0, 0.0);
  const Made made = set_down(corners, terrain_about(40, 10.0, slope));
  EXPECT_EQ(count_of(made.scene, "set_on_terrain"), 0U);
  EXPECT_EQ(count_of(made.scene, "feet_lowered"), 3U);
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_NEAR(made.lowest[b], slope(corners[b].x, 0.0), 1e-4);
    EXPECT_NEAR(made.highest[b], corners[b].z + 6.0, 1e-4);
  }
}

TEST(OnTerrain, AnotherDatumIsTold) {
  std::vector<Vec3> corners = kLevel;
  for (Vec3& c : corners) c.z = slope(c.x, 0.0) + 45.0;
  const Made made = set_down(corners, terrain_about(40, 10.0, slope), OnTerrain::Keep);
  EXPECT_GE(count_of(made.scene, "off_terrain"), 1U);
}

TEST(OnTerrain, BuildingsBesideTheTerrainAreTold) {
  std::vector<Vec3> corners = kLevel;
  corners.push_back({kEast + 5000.0, kNorth, 0.0});
  EXPECT_GE(count_of(set_down(corners, terrain_about(40, 10.0, slope)).scene, "off_terrain"), 1U);
}

TEST(OnTerrain, FarTerrainIsLowerByTheEarthsCurvature) {
  // A plain of 80 km at 100 m: 40 km away it lies 40^2 / (2 * 6371) km lower, 125.6 m; refraction
  // takes 0.13 of that.
  const Made made = set_down({{kEast - 5, kNorth - 5, 100}},
                             terrain_about(161, 500.0, [](double, double) { return 100.0; }));
  double lowest = 1e9, far = 0.0;
  for (const Vec3 v : made.scene.vertices) {
    if (std::abs(v.y) > 600.0) continue;
    if (std::abs(v.x) > far) far = std::abs(v.x), lowest = v.z;
  }
  EXPECT_NEAR(far, 40000.0, 300.0);
  EXPECT_NEAR(lowest, 100.0 - 0.87 * 125.6 * (far / 4e4) * (far / 4e4), 1.0);
  EXPECT_LT(made.scene.surfaces.size(), 12000U);  // of 51,206
}

double ridges(double x, double y) {
  const double u = (x - kEast) / 1000.0, v = (y - kNorth) / 1000.0, r = std::hypot(u, v);
  return 40.0 * std::max(0.0, r - 1.0) *
         (1.0 + 0.5 * std::sin(3.0 * u + 0.7 * v) + 0.05 * std::sin(17.0 * u) * std::cos(13.0 * v) +
          0.005 * std::sin(71.0 * v + 53.0 * u));
}

/// Highest altitudes of the terrain about the origin, by walking out over it in small steps.
std::vector<double> skyline(const Scene& scene) {
  RawScene raw;
  raw.scene.vertices = scene.vertices;
  raw.scene.surfaces = scene.surfaces;
  raw.is_building.assign(scene.objects.size(), 0);
  const GroundHeights ground(raw, extent_of_surfaces(scene));
  std::vector<double> altitude;
  for (double azimuth = 0.0; azimuth < 360.0; azimuth += 1.0) {
    const double s = std::sin(azimuth * std::numbers::pi / 180.0);
    const double c = std::cos(azimuth * std::numbers::pi / 180.0);
    double highest = -1.0;
    for (double r = 20.0; r < 9900.0; r += 5.0) {
      const auto z = ground.at(r * s, r * c);
      if (z) highest = std::max(highest, std::atan2(*z, r));
    }
    altitude.push_back(highest);
  }
  return altitude;
}

TEST(OnTerrain, TheSkylineStaysWithinItsShareOfTheTolerance) {
  const TemporaryFolder folder;
  ReadOptions options;
  options.crs = "EPSG:28992";
  options.up = UpAxis::Z;
  options.terrain = {folder.write("dem.tif", terrain_about(400, 50.0, ridges))};
  const auto city = folder.write("city.obj", boxes({{kEast - 5, kNorth - 5, 0}}));
  options.tolerance_pct = 1e-6;
  const Scene whole = read(city, options);
  const std::vector<double> exact = skyline(whole);
  EXPECT_GT(whole.surfaces.size(), 300'000U);
  std::size_t before = whole.surfaces.size();
  for (const double tolerance : {1.0, 5.0}) {
    options.tolerance_pct = tolerance;
    const Scene thin = read(city, options);
    const std::vector<double> found = skyline(thin);
    double worst = 0.0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
      worst = std::max(worst, std::abs(found[k] - exact[k]));
    }
    // A tenth of the tolerance, of the half sphere's quarter that a wall sees: pi / 4 radians.
    EXPECT_LE(worst, 0.001 * tolerance * std::numbers::pi / 4.0);
    EXPECT_LT(thin.surfaces.size(), before / 2);
    before = thin.surfaces.size();
  }
}

TEST(OnTerrain, AModelInMetresIsFoundByItsPlace) {
  // The terrain in UTM about 52.155 N, 5.387 E, climbing to the east; the model at its own origin.
  int zone = 0;
  bool is_north = false;
  double easting = 0.0, northing = 0.0, convergence = 0.0, scale = 0.0;
  GeographicLib::UTMUPS::Forward(52.155, 5.387, zone, is_north, easting, northing, convergence,
                                 scale, 31);
  Raster raster{easting - 200.0, northing + 200.0};
  raster.columns = raster.rows = 40;
  std::vector<float> z;
  for (int k = 0; k < 1600; ++k) z.push_back(30.0F + static_cast<float>(k % 40));
  const TemporaryFolder folder;
  ReadOptions options;
  options.up = UpAxis::Z;
  options.site = Location{Angle::degrees(52.155), Angle::degrees(5.387), 0.0};
  options.terrain = {folder.write("dem.tif", elevation_model(z, 25831, raster))};
  options.on_terrain = OnTerrain::Keep;
  const Scene scene = read(folder.write("model.obj", boxes({{-5, -5, 0}})), options);
  EXPECT_EQ(count_of(scene, "terrain_levelled"), 1U);
  RawScene raw;
  raw.scene = scene;
  raw.is_building = {1, 0};
  const GroundHeights ground(raw, extent_of_surfaces(scene));
  // One metre in ten to grid east, which is turned from true east to the south as grid north is
  // from true north to the east.
  const double turn = convergence * std::numbers::pi / 180.0;
  const auto middle = ground.at(0.0, 0.0), east = ground.at(100.0, 0.0),
             north = ground.at(0.0, 100.0);
  ASSERT_TRUE(middle && east && north);
  EXPECT_NEAR(*middle, 0.0, 0.6);
  EXPECT_NEAR(*east - *middle, 10.0 * std::cos(turn), 0.02);
  EXPECT_NEAR(*north - *middle, -10.0 * std::sin(turn), 0.02);
}

TEST(OnTerrain, TerrainOfTheCityIsKept) {
  // A sheet of the city's own at 3 m, 200 m wide, in an elevation model at 0 m.
  const TemporaryFolder folder;
  std::string sheet = boxes({{kEast - 5, kNorth - 5, 3}});
  const auto corner = [&](double x, double y) {
    sheet += "v " + std::to_string(kEast + x) + " " + std::to_string(kNorth + y) + " 3\n";
  };
  corner(-100, -100), corner(100, -100), corner(100, 100), corner(-100, 100);
  sheet += "o terrain\nf 9 10 11\nf 9 11 12\n";
  ReadOptions options;
  options.crs = "EPSG:28992";
  options.up = UpAxis::Z;
  options.terrain = {
      folder.write("dem.tif", terrain_about(80, 10.0, [](double, double) { return 0.0; }))};
  const Scene scene = read(folder.write("city.obj", sheet), options);
  RawScene raw;
  raw.scene = scene;
  raw.is_building.assign(scene.objects.size(), 0);
  raw.is_building[0] = 1;
  std::size_t low = 0;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    if (scene.objects[scene.surfaces.object[s]].type != "TINRelief") continue;
    for (const std::uint32_t v : scene.surfaces.outer_ring(s)) {
      const Vec3 p = scene.vertices[v];
      low += std::max(std::abs(p.x), std::abs(p.y)) < 80.0 ? 1 : 0;
    }
  }
  EXPECT_EQ(low, 0U);
  EXPECT_TRUE(GroundHeights(raw, extent_of_surfaces(scene)).at(300.0, 0.0));
}

TEST(OnTerrain, WhatDoesNotFitIsRefused) {
  const TemporaryFolder folder;
  ReadOptions options;
  options.up = UpAxis::Z;
  options.terrain = {folder.write("dem.tif", terrain_about(4, 10.0, slope))};
  const auto city = folder.write("city.obj", boxes({{0, 0, 0}}));
  EXPECT_THROW(read(city, options), InputError);  // no place
  options.crs = "EPSG:28992";
  EXPECT_NO_THROW(read(city, options));
  options.terrain = {folder.path() / "absent.tif"};
  EXPECT_THROW(read(city, options), InputError);
  EXPECT_THROW(on_terrain_named("float"), InputError);
}

}  // namespace
}  // namespace tenku
