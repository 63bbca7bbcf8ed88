// tenku radiosity: what it writes, and a side-lit room against a solution by other means.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "cli/lit_scene_files.h"
#include "output/field_writer.h"
#include "support/measured.h"
#include "support/reference_table.h"
#include "support/run_program.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;
using nlohmann::json;

/// Room of 6 x 8 x 3 m with an opening of 3 x 1.5 m in its south wall.
void write_room(const fs::path& folder) {
  std::string text;
  int vertices = 0;
  const auto quad = [&](const char* material, const std::vector<Vec3>& corners) {
    for (const Vec3 v : corners) {
      text +=
          "v " + std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) + "\n";
    }
    text += std::string("usemtl ") + material + "\nf";
    for (int k = 1; k <= 4; ++k) text += " " + std::to_string(vertices + k);
    text += "\n";
    vertices += 4;
  };
  const auto wall = [&](double x0, double y0, double x1, double y1, double z0, double z1) {
    quad("wall", {{x0, y0, z0}, {x1, y1, z0}, {x1, y1, z1}, {x0, y0, z1}});
  };
  quad("floor", {{0, 0, 0}, {6, 0, 0}, {6, 8, 0}, {0, 8, 0}});
  quad("ceil", {{0, 0, 3}, {6, 0, 3}, {6, 8, 3}, {0, 8, 3}});
  wall(0, 0, 0, 8, 0, 3);
  wall(6, 0, 6, 8, 0, 3);
  wall(0, 8, 6, 8, 0, 3);
  wall(0, 0, 1.5, 0, 0, 3);
  wall(4.5, 0, 6, 0, 0, 3);
  wall(1.5, 0, 4.5, 0, 0, 0.9);
  wall(1.5, 0, 4.5, 0, 2.4, 3);
  write_text(folder / "room.obj", text);
  write_text(folder / "room.toml",
             "[floor]\nreflectance = 0.2\n[wall]\nreflectance = 0.5\n[ceil]\nreflectance = 0.7\n");
}

const std::string kRoom = "radiosity room.obj --materials room.toml";
const std::string kOvercast = " --sky cie-overcast --sky-illuminance 10000";

TEST(RadiosityCommand, LightsASideLitRoom) {
  const fs::path folder = test_folder();
  write_room(folder);
  const ReferenceTable truth(TENKU_TEST_REFERENCE "/illuminance/room.csv");
  std::string points;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    points += truth.text(i, "x") + " " + truth.text(i, "y") + " " + truth.text(i, "z") + " 0 0 1\n";
  }
  write_text(folder / "room.pts", points);
  const auto run = run_tenku(
      kRoom + kOvercast + " --size-max 0.5 --sensors room.pts --out room.csv --json", folder);
  ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 3) << run.err;
  const ReferenceTable found(folder / "room.csv");
  ASSERT_EQ(found.size(), truth.size());
  WorstError worst("side-lit room, above 1 % daylight factor, percent");
  std::size_t inside = 0, counted = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double lux = truth.number(i, "total_lux");
    if (lux < 100.0) continue;
    const double error = found.number(i, "total_lux") - lux;
    worst.add(100.0 * error / lux, std::to_string(i));
    ++counted;
    inside += std::abs(error) <= found.number(i, "error_lux") + 0.001 * lux;  // its own exactness
  }
  EXPECT_LE(worst.worst(), 2.0);
  EXPECT_GE(inside, counted * 95 / 100);
  const json summary = json::parse(run.out);
  for (const char* key : {"patches", "elements", "vertices", "shots", "seconds", "emitted_lm",
                          "absorbed_lm", "escaped_lm", "unshot_lm"}) {
    EXPECT_TRUE(summary.contains(key)) << key;
  }
  for (const char* key : {"mesh_s", "form_factors_s", "solve_s", "size_field_s", "remesh_s"}) {
    EXPECT_TRUE(summary["seconds"].contains(key)) << key;
  }
  const double emitted = summary["emitted_lm"], absorbed = summary["absorbed_lm"],
               escaped = summary["escaped_lm"];
  EXPECT_NEAR(absorbed + escaped, emitted, 0.001 * emitted);
}

TEST(RadiosityCommand, WritesFieldsOfBothSidesAndOfTheShots) {
  const fs::path folder = test_folder();
  write_room(folder);
  const auto run =
      run_tenku(kRoom + kOvercast + " --size-max 1 --out room.vtp --watch shots", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const FieldMesh field = read_vtp(folder / "room.vtp");
  const auto has = [](const auto& arrays, const std::string& name) {
    return std::any_of(arrays.begin(), arrays.end(), [&](const auto& a) { return a.name == name; });
  };
  for (const char* name : {"sun_lux", "sky_lux", "reflected_lux", "total_lux", "error_lux",
                           "radiosity_lm_m2", "radiosity_r_lm_m2"}) {
    EXPECT_TRUE(has(field.point_values, name)) << name;
  }
  for (const char* name : {"surface_type", "object_id", "side", "patch"}) {
    EXPECT_TRUE(has(field.cell_codes, name)) << name;
  }
  EXPECT_TRUE(fs::exists(folder / "shots" / "shots_0000001.vtp"));
  EXPECT_GT(read_vtp(folder / "shots" / "shots_0000032.vtp").polygon_count(), 0U);
}

TEST(RadiosityCommand, GivesTheDaylightFactorOnAWorkPlane) {
  const fs::path folder = test_folder();
  write_room(folder);
  const auto run = run_tenku(
      kRoom + kOvercast + " --size-max 1 --work-plane 0.8 --spacing 2 --out df.csv", folder);
  ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 3) << run.err;
  const ReferenceTable table(folder / "df.csv");
  EXPECT_EQ(table.size(), 12U);  // 3 by 4 squares
  for (std::size_t i = 0; i < table.size(); ++i) {
    EXPECT_NEAR(table.number(i, "daylight_factor"), table.number(i, "total_lux") / 100.0, 1e-6);
  }
}

TEST(RadiosityCommand, SolvesATableOfSkies) {
  const fs::path folder = test_folder();
  write_room(folder);
  write_text(folder / "in.pts", "3 4 0.8 0 0 1\n");
  write_text(folder / "skies.csv",
             "sky,sky_illuminance_lx,sun_altitude_deg,sun_azimuth_deg,sun_illuminance_lx\n"
             "uniform,10000,,,\ncie-overcast,10000,,,\ncie:12,10000,40,180,0\nuniform,20000,,,\n");
  const std::string one = kRoom + " --size-max 1 --sensors in.pts --out ";
  const auto all = run_tenku(one + "all.csv --skies skies.csv --json", folder);
  ASSERT_TRUE(all.exit_code == 0 || all.exit_code == 3) << all.err;
  const ReferenceTable table(folder / "all.csv");
  ASSERT_EQ(table.size(), 4U);
  EXPECT_EQ(json::parse(all.out)["skies"].size(), 4U);
  const auto alone = run_tenku(one + "one.csv" + kOvercast, folder);
  ASSERT_TRUE(alone.exit_code == 0 || alone.exit_code == 3) << alone.err;
  const double lux = ReferenceTable(folder / "one.csv").number(0, "total_lux");
  EXPECT_NEAR(table.number(1, "total_lux"), lux, 0.005 * lux);
  EXPECT_NEAR(table.number(3, "total_lux"), 2.0 * table.number(0, "total_lux"),
              0.01 * table.number(3, "total_lux"));
  write_text(folder / "wrong.csv", "skyy\nuniform\n");
  const auto wrong = run_tenku(one + "w.csv --skies wrong.csv", folder);
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("skyy"), std::string::npos) << wrong.err;
}

TEST(RadiosityCommand, RefusesWhatItCannotDo) {
  const fs::path folder = test_folder();
  write_room(folder);
  for (const std::string wrong :
       {" --out room.png", " --out room.csv", " --out room.vtp --sensors in.pts",
        " --out room.vtp --mesh cubic", " --out room.vtp --tolerance 0",
        " --out room.vtp --form-factors magic", " --out nowhere/room.vtp"}) {
    const auto run = run_tenku(kRoom + kOvercast + wrong, folder);
    EXPECT_EQ(run.exit_code, 2) << wrong << run.err;
  }
}

const std::string kRectangles =
    "radiosity " TENKU_SOURCE_DIR
    "/scenes"
    "/verification/floating_rectangles/floating_rectangles.obj --materials " TENKU_SOURCE_DIR
    "/scenes"
    "/verification/floating_rectangles/materials.toml --sky none --ground none "
    "--tolerance 5 --out ";

TEST(RadiosityCommand, MakesTheMeshAnewToSuitTheLight) {
  const fs::path folder = test_folder();
  const auto run = run_tenku(kRectangles +
                                 "f.vtp --mesh bubble --shadow-edges --size-first 0.25 "
                                 "--elements-max 900 --rounds 1 --report f.html --json",
                             folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json summary = json::parse(run.out);
  ASSERT_EQ(summary["rounds"].size(), 2U);
  EXPECT_LE(summary["elements"].get<int>(), 900);
  EXPECT_GT(summary["rounds"][1]["mean_smallest_angle_deg"].get<double>(), 40.0);
  EXPECT_GT(summary["rounds"][1]["edges_within_20_pct"].get<double>(), 45.0);
  EXPECT_GT(summary["seconds"]["size_field_s"].get<double>(), 0.0);
  EXPECT_GT(summary["seconds"]["remesh_s"].get<double>(), 0.0);
  const FieldMesh field = read_vtp(folder / "f.vtp");
  const auto has = [](const auto& arrays, const std::string& name) {
    return std::any_of(arrays.begin(), arrays.end(), [&](const auto& a) { return a.name == name; });
  };
  EXPECT_TRUE(has(field.point_values, "asked_size_m"));
  EXPECT_TRUE(has(field.cell_values, "element_size_m"));
  std::ifstream file(folder / "f.html");
  const std::string page(std::istreambuf_iterator<char>(file), {});
  for (const char* text : {"First mesh", "Split where neighbours differ", "Bubble mesh"}) {
    EXPECT_NE(page.find(text), std::string::npos) << text;
  }
}

TEST(RadiosityCommand, SplitsTheMeshWhereNeighboursDiffer) {
  const fs::path folder = test_folder();
  const auto run = run_tenku(
      kRectangles + "f.vtp --mesh refine --elements-max 1200 --split-above 3 --json", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json rounds = json::parse(run.out)["rounds"];
  ASSERT_GE(rounds.size(), 2U);
  EXPECT_GT(rounds.back()["elements"], rounds.front()["elements"]);
  EXPECT_LE(rounds.back()["elements"].get<int>(), 1200);
  EXPECT_LT(rounds.back()["missed_pct"].get<double>(), rounds.front()["missed_pct"].get<double>());
}

TEST(RadiosityCommand, RefusesMeshOptionsThatDoNotBelong) {
  const fs::path folder = test_folder();
  for (const auto& [options, named] : std::vector<std::pair<std::string, std::string>>{
           {"--mesh bubbles", "bubbles"},
           {"--shadow-edges", "--shadow-edges"},
           {"--mesh bubble --split-above 3", "--split-above"},
           {"--rounds 2", "--rounds"},
           {"--mesh bubble --size-min 0.5 --size-max 0.1", "size"}}) {
    const auto run = run_tenku(kRectangles + "f.vtp " + options, folder);
    EXPECT_EQ(run.exit_code, 2) << options;
    EXPECT_NE(run.err.find(named), std::string::npos) << run.err;
  }
}

}  // namespace
}  // namespace tenku
