// One place by two models.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/lit_scene_files.h"
#include "support/reference_table.h"
#include "support/run_program.h"

namespace tenku {
namespace {

using namespace testing_support;
using nlohmann::json;

/// A block of 10 m on a field; in LOD 1 it is 20 m high.
const char* const kTwoLevels =
    R"({"type":"CityJSON","version":"2.0","metadata":{"referenceSystem":)"
    R"("https://www.opengis.net/def/crs/EPSG/0/7415"},"transform":{"scale":[1,1,1],)"
    R"("translate":[85000,447000,0]},"CityObjects":{"block":{"type":"Building","geometry":[)"
    R"({"type":"Solid","lod":"2","boundaries":[[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],)"
    R"([[2,3,7,6]],[[3,0,4,7]]]]},)"
    R"({"type":"Solid","lod":"1","boundaries":[[[[0,3,2,1]],[[8,9,10,11]],[[0,1,9,8]],)"
    R"([[1,2,10,9]],[[2,3,11,10]],[[3,0,8,11]]]]}]},)"
    R"("field":{"type":"TINRelief","geometry":[{"type":"CompositeSurface","lod":"1","boundaries":)"
    R"([[[12,13,14]],[[12,14,15]]]}]}},"vertices":[[0,0,0],[10,0,0],[10,10,0],[0,10,0],[0,0,10],)"
    R"([10,0,10],[10,10,10],[0,10,10],[0,0,20],[10,0,20],[10,10,20],[0,10,20],[-60,-60,0],)"
    R"([60,-60,0],[60,60,0],[-60,60,0]]})";

const std::string kLight =
    " --sun-altitude 45 --sun-azimuth 180 --sky uniform --sky-illuminance 10000 "
    "--sun-illuminance 60000 --bounces 0 --tolerance 1 --spacing 2 --json --quiet";

TEST(CompareCommand, TellsWhereTheSimplerModelIsWrong) {
  const auto folder = test_folder();
  write_text(folder / "two.city.json", kTwoLevels);
  const auto run = run_tenku("compare two.city.json --with-lod 1 --out o" + kLight, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json told = json::parse(run.out);
  const json& all = told["table"][0];
  // Of 120 by 120 m less the block; the shadow is 10 m longer, over the block's width of 10 m.
  const double area = 120.0 * 120.0 - 100.0;
  EXPECT_NEAR(all["squares"].get<double>() * 4.0, area, 0.04 * area);
  EXPECT_NEAR(all["sun_differs"].get<double>() * area, 100.0, 30.0);
  EXPECT_LT(all["mean_pct"], 0.0);  // darker with the higher block
  EXPECT_LT(all["median_pct"], 2.0);
  // A place in the longer shadow has lost sun of 42,426 lx and little else.
  EXPECT_NEAR(all["worst_pct"].get<double>(), 100.0 * 42426.0 / 52426.0, 6.0);
  EXPECT_GT(all["within"]["20"], all["within"]["2"]);
  const ReferenceTable table((folder / "o/difference.csv").string());
  ASSERT_EQ(table.size(), all["squares"].get<std::size_t>());
  for (std::size_t k = 0; k < table.size(); ++k) {
    const double x = table.number(k, "x") - 85000.0, y = table.number(k, "y") - 447000.0;
    if (x > 3.0 && x < 7.0 && y > 22.0 && y < 28.0) {
      EXPECT_LT(table.number(k, "difference_pct"), -60.0);
    }
    if (y < -20.0) {
      EXPECT_GT(table.number(k, "difference_pct"), -4.0);
    }
    EXPECT_LT(table.number(k, "error_pct"), 2.0);
  }
  for (const char* name : {"difference.png", "difference.tif"}) {
    EXPECT_GT(std::filesystem::file_size(folder / "o" / name), 1000U) << name;
  }
}

TEST(CompareCommand, TheSameModelIsTheSameWithinTheErrors) {
  const auto folder = test_folder();
  write_text(folder / "two.city.json", kTwoLevels);
  const auto run = run_tenku("compare two.city.json --with two.city.json --out o" + kLight, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_LT(json::parse(run.out)["table"][0]["worst_pct"], 2.0);
  EXPECT_EQ(json::parse(run.out)["covered_in_second"], 0);
}

TEST(CompareCommand, WantsAnotherModelOfTheSamePlace) {
  const auto folder = test_folder();
  write_text(folder / "two.city.json", kTwoLevels);
  write_text(folder / "room.obj", "v 0 0 0\nv 9 0 0\nv 9 9 0\nf 1 2 3\n");
  const auto none = run_tenku("compare two.city.json --out o" + kLight, folder);
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("--with"), std::string::npos) << none.err;
  const auto other = run_tenku("compare two.city.json --with room.obj --out o" + kLight, folder);
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("place"), std::string::npos) << other.err;
}

}  // namespace
}  // namespace tenku
