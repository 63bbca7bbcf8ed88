// `tenku reflections`: what it writes, and how it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/lit_scene_files.h"
#include "core/csv.h"
#include "core/units.h"
#include "core/vec3.h"
#include "output/field_writer.h"
#include "support/run_program.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;
using nlohmann::json;

/// A mirror of 2 m by 3 m, its foot 2 m over the ground, that faces south.
const char* const kMirrorScene =
    "o ground\nv -60 -60 0\nv 60 -60 0\nv 60 60 0\nv -60 60 0\nf 1 2 3 4\n"
    "o mirror\nv -1 0 2\nv 1 0 2\nv 1 0 5\nv -1 0 5\nf 5 6 7 8\n";

void write_mirror_scene(const fs::path& folder) {
  write_text(folder / "m.obj", kMirrorScene);
  write_text(folder / "m.toml", "[mirror]\nmirror = 1.0\n");
}

const std::string kScene = "reflections m.obj --materials m.toml ";
const std::string kSunThere = "--sun-altitude 40 --sun-azimuth 170 --sun-illuminance 50000 ";
const std::string kDay = "--lat 52 --lon 4.3 --time 2026-06-21T12:00+02:00 ";

TEST(ReflectionsCommand, AMirrorThrowsItsLightWhereTheClosedFormSays) {
  const fs::path folder = test_folder();
  write_mirror_scene(folder);
  const ProgramRun run = run_tenku(kScene + kSunThere + "--out - --json --out m.geojson", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const CsvInput table(run.out.substr(0, run.out.find("{\n")), "out");
  ASSERT_GT(table.size(), 0U);
  const Vec3 sun = direction_from(Angle::degrees(170.0), Angle::degrees(40.0));
  double lumen = 0.0;
  for (std::size_t row = 0; row < table.size(); ++row) {
    EXPECT_EQ(table.text(row, "object"), "ground");
    EXPECT_EQ(table.text(row, "panels"), "mirror");
    EXPECT_NEAR(table.number(row, "lux"), 50000.0 * sun.z, 1e-6);
    lumen += table.number(row, "lux") * table.number(row, "area_m2");
    // The ways to the ground are 2 to 5 m / sin(altitude); across them the disc is 0.533 degrees.
    EXPECT_GT(table.number(row, "blur_m"), 2.0 / (sun.z * sun.z) * 0.0093);
    EXPECT_LT(table.number(row, "blur_m"), 5.001 / (sun.z * sun.z) * 0.009305);
  }
  EXPECT_NEAR(lumen, 50000.0 * 6.0 * -sun.y, 1e-3 * lumen);
  // Without a place the coordinates are those of the file: x on, y back by z / tan(altitude).
  const json features = json::parse(contents_of(folder / "m.geojson")).at("features");
  double south = 0.0;
  for (const json& feature : features) {
    const json ring = feature.at("geometry").at("coordinates").at(0);
    EXPECT_EQ(ring.front(), ring.back());
    for (const json& p : ring) south = std::min(south, p.at(1).get<double>());
  }
  EXPECT_NEAR(south, 5.0 * sun.y / sun.z, 1e-3);
}

TEST(ReflectionsCommand, ADayHasEveryOutput) {
  const fs::path folder = test_folder();
  write_mirror_scene(folder);
  write_text(folder / "eyes.csv", "name,x,y,z\nwalker,0,-6,1.6\naway,0,30,1.6\n");
  const ProgramRun run = run_tenku(
      kScene + "--lat 52 --lon 4.3 --time 2026-12-21T12:00+01:00 " +
          "--day --step 10 --out d.csv --out d.geojson --out d.vtp --panels p.csv --windows w.csv "
          "--report d.html --observers eyes.csv --views v.csv --json",
      folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json summary = json::parse(run.out);
  EXPECT_EQ(summary.at("panels"), 1);
  EXPECT_LT(summary.at("balance_error"), 1e-9);
  const CsvInput panels(contents_of(folder / "p.csv"), "p.csv");
  EXPECT_NEAR(panels.number(0, "area_m2"), 6.0, 1e-9);
  EXPECT_NEAR(panels.number(0, "azimuth_deg"), 180.0, 1e-6);
  // The sun is up for 465 minutes, always south of the mirror. Near rise and set, at an azimuth of
  // 128 degrees, the light goes 2 m / tan(altitude) at least and passes over the ground's edge, 76
  // m away, until the sun is 1.5 degrees high: 19 minutes at either end.
  EXPECT_NEAR(panels.number(0, "minutes"), 427.0, 15.0);
  const CsvInput views(contents_of(folder / "v.csv"), "v.csv");
  ASSERT_GT(views.size(), 0U);
  for (std::size_t row = 0; row < views.size(); ++row) {
    EXPECT_EQ(views.text(row, "observer"), "walker");
    // The mirror is seen due north, its edges (2 - 1.6) / 6 and (5 - 1.6) / 6 high, and 1 / 6
    // aside.
    EXPECT_GT(views.number(row, "altitude_deg"), 3.5);
    EXPECT_LT(views.number(row, "altitude_deg"), 29.9);
    EXPECT_LT(std::abs(std::remainder(views.number(row, "azimuth_deg"), 360.0)), 9.8);
  }
  // It comes into view and leaves when the rim of the disc, 0.271 degrees wide in that month and
  // 14.4 degrees high, passes the upright edges of the mirror, 1 m aside at 6 m.
  const double edge = std::atan2(1.0, 6.0) * 180.0 / kPi + 0.271 / std::cos(14.4 * kPi / 180.0);
  for (const auto& [column, row] : {std::pair("from", std::size_t{0}), {"to", views.size() - 1}}) {
    const ProgramRun sun =
        run_tenku("sun --lat 52 --lon 4.3 --json --time " + views.text(row, column), folder);
    const double azimuth = json::parse(sun.out).at("azimuth_deg");
    EXPECT_NEAR(std::abs(azimuth - 180.0), edge, 0.15) << column;  // 30 s: 0.13 degrees
  }
  const FieldMesh field = read_vtp(folder / "d.vtp");
  EXPECT_EQ(field.polygon_count(), summary.at("polygons").get<std::size_t>());
  EXPECT_NE(contents_of(folder / "d.html").find("By panel"), std::string::npos);
}

TEST(ReflectionsCommand, GeoJsonIsInLongitudeAndLatitudeWhereThePlaceIsKnown) {
  const fs::path folder = test_folder();
  write_mirror_scene(folder);
  ASSERT_EQ(run_tenku(kScene + kDay + "--out d.geojson", folder).exit_code, 0);
  const json features = json::parse(contents_of(folder / "d.geojson")).at("features");
  ASSERT_FALSE(features.empty());
  for (const json& feature : features) {
    for (const json& p : feature.at("geometry").at("coordinates").at(0)) {
      // A degree of latitude at 52 degrees is 111,267 m (WGS 84), one of longitude 68,678 m.
      EXPECT_NEAR(p.at(0).get<double>(), 4.3, 20.0 / 68678.0);
      EXPECT_NEAR(p.at(1).get<double>(), 52.0, 20.0 / 111267.0);
      EXPECT_NE(p.at(1).get<double>(), 52.0);
    }
  }
}

TEST(ReflectionsCommand, NightIsDoneAndTold) {
  const fs::path folder = test_folder();
  write_mirror_scene(folder);
  const ProgramRun run =
      run_tenku(kScene + "--lat 52 --lon 4.3 --time 2026-06-21T01:00+02:00 --out n.csv", folder);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("does not shine"), std::string::npos) << run.err;
}

TEST(ReflectionsCommand, FacingMirrorsBeyondTheDepthAreTold) {
  const fs::path folder = test_folder();
  write_text(folder / "m.obj", std::string(kMirrorScene) +
                                   "o other\nusemtl mirror\nv 3 -3 0\nv -3 -3 0\nv -3 -3 1.5\n"
                                   "v 3 -3 1.5\nf 9 10 11 12\n");
  write_text(folder / "m.toml", "[mirror]\nmirror = 1.0\n");
  const ProgramRun one = run_tenku(kScene + kSunThere + "--depth 1 --out m.csv", folder);
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_NE(one.err.find("mirrors_beyond_depth"), std::string::npos) << one.err;
  const ProgramRun three = run_tenku(kScene + kSunThere + "--depth 3 --out m.csv", folder);
  EXPECT_EQ(three.err.find("mirrors_beyond_depth"), std::string::npos) << three.err;
}

TEST(ReflectionsCommand, RefusesWhatIsWrong) {
  const fs::path folder = test_folder();
  write_mirror_scene(folder);
  write_text(folder / "bad.csv", "name,x,y\na,1,2\n");
  write_text(folder / "nan.csv", "x,y,z\n1,2,here\n");
  write_text(folder / "one.csv", "x,y,z\n1,2,3\n");
  const std::string out = "--out m.csv ";
  const std::vector<std::pair<std::string, std::string>> cases{
      {kScene + out, "--time"},
      {kScene + kSunThere, "--out"},
      {kScene + kSunThere + "--out m.pdf", ".geojson"},
      {kScene + kSunThere + out + "--day", "--day"},
      {kScene + kDay + out + "--day --year", "not both"},
      {kScene + kDay + out + "--day --step 0", "--step"},
      {kScene + kDay + out + "--day --step nan", "--step"},
      {kScene + kSunThere + out + "--depth 0", "--depth"},
      {kScene + kSunThere + out + "--depth 99", "--depth"},
      {kScene + kSunThere + out + "--least-lux -1", "--least-lux"},
      {kScene + kSunThere + out + "--overlaps some", "--overlaps"},
      {kScene + kDay + out + "--views v.csv", "--observers"},
      {kScene + kDay + out + "--observers one.csv", "--views"},
      {kScene + kDay + "--observers bad.csv --views v.csv", "z"},
      {kScene + kDay + "--observers nan.csv --views v.csv", "nan.csv"},
      {kScene + kDay + "--path one.csv --views v.csv", "path"},
      {kScene + kDay + "--path one.csv --path-step 0 --views v.csv", "--path-step"},
      {kScene + kDay + out + "--sky cie-overcast", "no sun"},
      {"reflections m.obj " + kSunThere + out, "mirror"},
      {"reflections none.obj " + kSunThere + out, "none.obj"},
      {kScene + kSunThere + "--out no/where.csv", "no"},
  };
  for (const auto& [arguments, word] : cases) {
    const ProgramRun run = run_tenku(arguments, folder);
    EXPECT_EQ(run.exit_code, 2) << arguments << "\n" << run.err;
    EXPECT_NE(run.err.find(word), std::string::npos) << arguments << "\n" << run.err;
  }
}

}  // namespace
}  // namespace tenku
