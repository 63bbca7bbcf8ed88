// Where sensors lie: around a place of a city of tiles, and in the axes of the file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/lit_scene_files.h"
#include "core/units.h"
#include "support/reference_table.h"
#include "support/run_program.h"

namespace tenku {
namespace {

using namespace testing_support;
using nlohmann::json;

/// A tile of the Netherlands with one block, `half` m to all sides of its middle.
void write_tile(const std::filesystem::path& file, double x, double y, double half, double height) {
  json vertices = json::array();
  for (const double z : {0.0, height}) {
    vertices.push_back({-half, -half, z});
    vertices.push_back({half, -half, z});
    vertices.push_back({half, half, z});
    vertices.push_back({-half, half, z});
  }
  const json faces =
      json::parse("[[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]]");
  const std::string id = file.stem().string();
  const json tile{
      {"type", "CityJSON"},
      {"version", "2.0"},
      {"metadata", {{"referenceSystem", "https://www.opengis.net/def/crs/EPSG/0/7415"}}},
      {"transform", {{"scale", {1, 1, 1}}, {"translate", {x, y, 0}}}},
      {"CityObjects",
       {{id,
         {{"type", "Building"},
          {"geometry", {{{"type", "Solid"}, {"lod", "2"}, {"boundaries", faces}}}}}}}},
      {"vertices", vertices}};
  write_text(file, tile.dump());
}

const std::string kLight =
    " --sky uniform --sky-illuminance 10000 --bounces 0 --engine rays --lod off --quiet ";

/// The table that `illuminance` writes.
ReferenceTable table_of(const std::filesystem::path& folder, const std::string& what) {
  const auto run = run_tenku("illuminance " + what + " --out a.csv", folder);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return ReferenceTable((folder / "a.csv").string());
}

TEST(Around, LeavesOutWhatTakesLessThanATenthOfTheTolerance) {
  const auto folder = test_folder();
  std::filesystem::create_directory(folder / "city");
  write_tile(folder / "city/here.city.json", 85000, 447000, 5, 10);
  // 20 m high, nowhere nearer than 5.6 km: under 0.0036 rad, of 0.0039 that may be left out at 5 %.
  for (int k = 0; k < 8; ++k) {
    const double way = k * kPi / 4.0, away = 9000.0;
    write_tile(folder / ("city/slab" + std::to_string(k) + ".city.json"),
               85000 + away * std::cos(way), 447000 + away * std::sin(way), 2400, 20);
  }
  write_text(folder / "wall.pts", "85000 446994.99 0.1 0 -1 0\n");
  const auto sky_lux = [&](const std::string& how) {
    return table_of(
               folder,
               "city --sensors wall.pts --sky uniform --sky-illuminance 10000 --bounces 0 " + how)
        .number(0, "sky_lux");
  };
  const std::string place = " --around 85000,447000,50";
  // The sum over the slabs' edges of the sky that they hide.
  EXPECT_NEAR(sky_lux("--tolerance 0.1"), 5000.0 * (1.0 - 0.00333), 1.5);
  EXPECT_NEAR(sky_lux("--tolerance 0.1" + place), 5000.0 * (1.0 - 0.00333), 1.5);
  EXPECT_NEAR(sky_lux("--tolerance 5" + place), 5000.0, 3.0);  // less than 0.5 % brighter
  const auto plan = run_tenku(
      "plan city --sensors wall.pts --tolerance 5 --bounces 0 --sky uniform "
      "--sky-illuminance 10000" +
          place,
      folder);
  EXPECT_NE(plan.out.find("8 of 9 tiles, the nearest 55"), std::string::npos) << plan.out;
  const auto at_2 = run_tenku("inspect city --json" + place, folder);
  EXPECT_EQ(at_2.out.find("tiles_left_out"), std::string::npos);
}

TEST(Around, CutsGridsAtTheSquare) {
  const auto folder = test_folder();
  write_tile(folder / "wide.city.json", 85000, 447000, 100, 10);
  const auto run = run_tenku(
      "illuminance wide.city.json --around 85090,447000,20 --grid roofs,walls "
      "--spacing 3 --tolerance 5 --json --out a.vtp" +
          kLight,
      folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const ReferenceTable sensors = table_of(
      folder,
      "wide.city.json --around 85090,447000,20 --grid roofs,walls --spacing 3 --tolerance 5" +
          kLight);
  ASSERT_GT(sensors.size(), 100U);
  double east = 0.0;
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    EXPECT_LE(std::abs(sensors.number(k, "x") - 85090.0), 20.6);  // sides are along true north
    EXPECT_LE(std::abs(sensors.number(k, "y") - 447000.0), 20.6);
    east = std::max(east, sensors.number(k, "x"));
  }
  EXPECT_NEAR(east, 85100.0, 0.01);  // the east wall
  EXPECT_EQ(
      run_tenku("illuminance wide.city.json --around 1,2 --grid roofs --out b.csv" + kLight, folder)
          .exit_code,
      2);
}

/// Sky view and normals of a grid, and of sensors that are what the grid's table says.
void expect_same_again(const std::filesystem::path& folder, const std::string& scene) {
  const std::string light = " --tolerance 0.5" + kLight;
  const ReferenceTable first = table_of(folder, scene + " --grid walls,roofs --spacing 3" + light);
  std::string sensors;
  for (std::size_t k = 0; k < first.size(); ++k) {
    for (const char* column : {"x", "y", "z", "nx", "ny", "nz"}) {
      sensors += first.text(k, column) + " ";
    }
    sensors += "\n";
  }
  write_text(folder / "a.pts", sensors);
  const ReferenceTable second = table_of(folder, scene + " --sensors a.pts" + light);
  ASSERT_EQ(second.size(), first.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_NEAR(second.number(k, "sky_lux"), first.number(k, "sky_lux"),
                first.number(k, "error_lux") + second.number(k, "error_lux") + 1.0)
        << "line " << k;
    for (const char* column : {"nx", "ny", "nz"}) {
      EXPECT_NEAR(second.number(k, column), first.number(k, column), 1e-6);
    }
  }
}

TEST(GridTables, AreSensorsInTheAxesOfTheFile) {
  const auto folder = test_folder();
  // y points up: the roof's normal is 0 1 0.
  write_text(folder / "y_up.obj",
             "# y up\nv 0 0 0\nv 6 0 0\nv 6 0 6\nv 0 0 6\nv 0 9 0\nv 6 9 0\nv 6 9 6\nv 0 9 6\n"
             "f 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
  expect_same_again(folder, "y_up.obj --up y");
  // Grid north is 2.6 degrees west of true north there.
  write_tile(folder / "block.city.json", 20000, 390000, 5, 10);
  expect_same_again(folder, "block.city.json");
  const ReferenceTable block((folder / "a.csv").string());
  for (std::size_t k = 0; k < block.size(); ++k) {
    const double largest = std::max(
        {std::abs(block.number(k, "nx")), std::abs(block.number(k, "ny")), block.number(k, "nz")});
    EXPECT_NEAR(largest, 1.0, 1e-6);  // the block's walls lie along the map's axes
  }
}

}  // namespace
}  // namespace tenku
