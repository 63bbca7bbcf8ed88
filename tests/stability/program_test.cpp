// The program on scenes that methods bear badly: both engines agree within their intervals, and say
// where and why they may not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "cli/lit_scene_files.h"
#include "pictures/picture_codec.h"
#include "stability/scene_texts.h"
#include "support/reference_table.h"
#include "support/run_program.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;

const std::string kDirect = kSky + " --sun-illuminance 0 --bounces 0 --gl osmesa";

std::string sensor_lines(std::size_t count, const std::function<Vec3(double)>& at) {
  std::string lines;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3 p = at((static_cast<double>(k) + 0.5) / static_cast<double>(count));
    lines += fmt::format("{:.9g} {:.9g} {:.9g} 0 0 1\n", p.x, p.y, p.z);
  }
  return lines;
}

/// One scene lit by either engine; the engines differ by no more than both their intervals at 19
/// of 20 sensors.
struct BothRuns {
  ProgramRun rays, maps;

  BothRuns(const fs::path& folder, const std::string& scene, const std::string& options) {
    const auto run = [&](const std::string& engine) {
      return run_tenku("illuminance " + scene + " --sensors s.pts --engine " + engine + " --out " +
                           engine + ".csv " + options,
                       folder);
    };
    rays = run("rays"), maps = run("shadow-maps");
    for (const ProgramRun* one : {&rays, &maps}) {
      EXPECT_TRUE(one->exit_code == 0 || one->exit_code == 3) << one->exit_code << one->err;
    }
    if (HasFailure()) return;
    compare(ReferenceTable((folder / "rays.csv").string()),
            ReferenceTable((folder / "shadow-maps.csv").string()));
  }

  static bool HasFailure() { return ::testing::Test::HasFailure(); }

  static void compare(const ReferenceTable& a, const ReferenceTable& b) {
    ASSERT_EQ(a.size(), b.size());
    double worst = 0.0, mean = 0.0;
    std::size_t inside = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double off = std::abs(a.number(i, "total_lux") - b.number(i, "total_lux"));
      inside += off <= a.number(i, "error_lux") + b.number(i, "error_lux") + 1e-6;
      worst = std::max(worst, off);
      mean += off / static_cast<double>(a.size());
    }
    std::printf(
        "[ MEASURED ] %s: engines differ by %.3f lx in the mean, %.3f at worst; %zu of %zu "
        "within both intervals\n",
        ::testing::UnitTest::GetInstance()->current_test_info()->name(), mean, worst, inside,
        a.size());
    EXPECT_GE(static_cast<double>(inside), 0.95 * static_cast<double>(a.size()));
  }

  void expect_told(const std::string& code, bool by_rays = true) const {
    EXPECT_EQ(rays.err.find(code) != std::string::npos, by_rays) << rays.err;
    EXPECT_NE(maps.err.find(code), std::string::npos) << maps.err;
  }
};

/// Five houses in a row on a floor of 400 m, and sensors on the floor about them.
ObjText row_of_houses() {
  ObjText text;
  for (int k = 0; k < 5; ++k) text.box(fmt::format("house{}", k), {30.0 * k, 0, 0}, {10, 10, 9});
  text.box("floor", {-200, -200, -1}, {400, 400, 1});
  return text;
}

std::string about_the_houses() {
  return sensor_lines(150, [](double t) {
    return Vec3{150.0 * t - 20.0, -1.0 - 15.0 * (0.5 + 0.5 * std::sin(300.0 * t)), 0.0};
  });
}

TEST(ProgramOnHardCases, AGrazingSunIsTold) {
  const fs::path folder = test_folder();
  write_text(folder / "s.obj", row_of_houses().text());
  write_text(folder / "s.pts", about_the_houses());
  const std::string sun =
      " --gl osmesa --bounces 0 --sun-azimuth 170 --sun-illuminance 20000" + kSky;
  for (const char* altitude : {"0.3", "1", "1.9"}) {
    BothRuns(folder, "s.obj", sun + " --sun-altitude " + altitude).expect_told("grazing_sun");
  }
  const ProgramRun high = run_tenku(
      "illuminance s.obj --sensors s.pts --out o.csv" + sun + " --sun-altitude 2.5", folder);
  EXPECT_EQ(high.err.find("grazing_sun"), std::string::npos) << high.err;
}

TEST(ProgramOnHardCases, WideTexelsAreTold) {
  const fs::path folder = test_folder();
  write_text(folder / "s.obj", row_of_houses().text());
  // Regions are cut for 2048 texels; without a budget of detail maps have 1024.
  write_text(folder / "s.pts", about_the_houses() + "-600 -300 0 0 0 1\n600 -300 0 0 0 1\n");
  const BothRuns wide(folder, "s.obj", kDirect + " --lod off");
  wide.expect_told("texels_wide", false);
  EXPECT_NE(wide.maps.err.find("152 sensors about 0.00 -150."), std::string::npos) << wide.maps.err;
  write_text(folder / "s.pts", about_the_houses());
  const BothRuns as_asked(folder, "s.obj", kDirect);
  EXPECT_EQ(as_asked.maps.err.find("texels_wide"), std::string::npos) << as_asked.maps.err;
}

TEST(ProgramOnHardCases, WallsThatCoincideAreTold) {
  const fs::path folder = test_folder();
  ObjText text = row_of_houses();
  text.box("neighbour", {10, 0, 0}, {20, 10, 9});  // between the first two, a wall with each
  write_text(folder / "s.obj", text.text());
  write_text(folder / "s.pts", about_the_houses() + "10 5 4 1 0 0\n10 5 4 -1 0 0\n");
  const BothRuns runs(folder, "s.obj", kDirect);
  runs.expect_told("coincident_faces");
  runs.expect_told("2 x coincident_faces");
  runs.expect_told("house0");
  runs.expect_told("no_light");  // the two sensors on the common wall
}

TEST(ProgramOnHardCases, AStrayObjectFiveHundredKilometresFromTheOriginIsTold) {
  const fs::path folder = test_folder();
  ObjText text = row_of_houses();
  text.box("stray", {1e6, 0, 0}, {9, 9, 9});
  write_text(folder / "s.obj", text.text());
  write_text(folder / "s.pts", about_the_houses());
  const BothRuns runs(folder, "s.obj", kDirect);
  runs.expect_told("far_from_origin");
  runs.expect_told("stray");
  // Against the same houses without it: what the finding warns of.
  write_text(folder / "near.obj", row_of_houses().text());
  ASSERT_EQ(
      run_tenku("illuminance near.obj --sensors s.pts --out near.csv" + kDirect, folder).exit_code,
      0);
  for (const char* engine : {"rays.csv", "shadow-maps.csv"}) {
    std::printf("%s against the scene without the stray object:\n", engine);
    BothRuns::compare(ReferenceTable((folder / "near.csv").string()),
                      ReferenceTable((folder / engine).string()));
  }
}

TEST(ProgramOnHardCases, SensorsInsideAHouseAreTold) {
  const fs::path folder = test_folder();
  write_text(folder / "s.obj", row_of_houses().text());
  write_text(folder / "s.pts", about_the_houses() + "35 5 1 0 0 1\n36 6 2 1 0 0\n");
  const BothRuns runs(folder, "s.obj", kDirect);
  runs.expect_told("2 x no_light");
  runs.expect_told("sensor 151");
}

TEST(ProgramOnHardCases, ACameraInsideAHouseIsTold) {
  const fs::path folder = test_folder();
  write_text(folder / "s.obj", row_of_houses().text());
  const auto view = [&](const std::string& engine, const std::string& eye) {
    return run_tenku("render s.obj --eye " + eye + " --target 200,5,3 --size 24x16 --show " +
                         "illuminance --engine " + engine + " --out " + engine + ".exr" + kDirect,
                     folder);
  };
  for (const std::string engine : {"rays", "shadow-maps"}) {
    const ProgramRun inside = view(engine, "35,5,3");
    EXPECT_TRUE(inside.exit_code == 0 || inside.exit_code == 3) << inside.err;
    EXPECT_NE(inside.err.find("eye_inside"), std::string::npos) << inside.err;
    EXPECT_NE(inside.err.find("house1"), std::string::npos) << inside.err;
    const auto picture = picture_codec().read(folder / (engine + ".exr"));
    EXPECT_EQ(std::count(picture.values.begin(), picture.values.end(), 0.0F),
              static_cast<std::ptrdiff_t>(picture.values.size()));
    const ProgramRun outside = view(engine, "25,-30,3");
    EXPECT_EQ(outside.err.find("eye_inside"), std::string::npos) << outside.err;
  }
}

TEST(ProgramOnHardCases, ACityWithoutHeightIsTold) {
  const fs::path folder = test_folder();
  write_text(folder / "flat.city.json", city_of(6, 6));
  write_text(folder / "s.pts", sensor_lines(40, [](double t) {
               return Vec3{140.0 * t - 20.0, 9.0 * std::sin(99.0 * t), 0.0};
             }));
  for (const char* ground : {"auto", "none"}) {
    const BothRuns runs(folder, "flat.city.json", kDirect + " --ground " + ground);
    runs.expect_told("6 x flat_city");
    runs.expect_told("house0");
    const ReferenceTable lit((folder / "shadow-maps.csv").string());
    for (std::size_t i = 0; i < lit.size(); ++i) {
      EXPECT_NEAR(lit.number(i, "total_lux"), 10'000.0, 2.0) << i;  // nothing stands anywhere
    }
  }
}

TEST(ProgramOnHardCases, ATriangleOfTenKilometresIsTold) {
  const fs::path folder = test_folder();
  ObjText text = row_of_houses();
  text.triangle("screen", {0, -5000, 40}, {9000, 0, 40}, {0, 5000, 40});
  write_text(folder / "s.obj", text.text());
  write_text(folder / "s.pts", about_the_houses());
  const BothRuns runs(folder, "s.obj", kDirect);
  runs.expect_told("huge_triangle");
  runs.expect_told("screen");
}

}  // namespace
}  // namespace tenku
