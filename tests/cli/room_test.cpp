// Sensors of a room have all its reflections from the commands that light any scene.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "cli/lit_scene_files.h"
#include "support/measured.h"
#include "support/reference_table.h"
#include "support/run_program.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;

const std::string kRoomModel = "'" TENKU_TEST_REFERENCE "/radiosity/side_lit_room.obj'";
const std::string kRoomLight =
    " --sensors room.pts --materials room.toml --sky cie-overcast --sky-illuminance 10000";
constexpr double kOnePercent_lux = 100.0;  // daylight factor

ReferenceTable write_sensors(const fs::path& folder) {
  ReferenceTable truth(TENKU_TEST_REFERENCE "/illuminance/room.csv");
  std::string points;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    points += truth.text(i, "x") + " " + truth.text(i, "y") + " " + truth.text(i, "z") + " 0 0 1\n";
  }
  write_text(folder / "room.pts", points);
  write_text(folder / "room.toml",
             "[floor]\nreflectance = 0.2\n[wall]\nreflectance = 0.5\n[ceil]\nreflectance = 0.7\n");
  return truth;
}

TEST(RoomLight, IsThatOfTheReferenceWithoutAnOption) {
  const fs::path folder = test_folder();
  const ReferenceTable truth = write_sensors(folder);
  const auto run = run_tenku("illuminance " + kRoomModel + kRoomLight + " --out room.csv", folder);
  ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 3) << run.err;
  const ReferenceTable found(folder / "room.csv");
  ASSERT_EQ(found.size(), truth.size());
  WorstError worst("illuminance of a side-lit room, above 1 % daylight factor, percent");
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double lux = truth.number(i, "total_lux");
    if (lux < kOnePercent_lux) continue;
    worst.add(100.0 * (found.number(i, "total_lux") - lux) / lux, std::to_string(i));
  }
  EXPECT_LE(worst.worst(), 2.0);
}

TEST(RoomLight, FewBouncesAreFollowedAsPaths) {
  const fs::path folder = test_folder();
  write_sensors(folder);
  const std::string coarse =
      "illuminance " + kRoomModel + kRoomLight + " --tolerance 20 --bounces ";
  const auto one = run_tenku(coarse + "1 --out one.csv", folder);
  const auto all = run_tenku(coarse + "5 --out all.csv", folder);
  ASSERT_TRUE(one.exit_code == 0 || one.exit_code == 3) << one.err;
  ASSERT_TRUE(all.exit_code == 0 || all.exit_code == 3) << all.err;
  EXPECT_EQ(one.err.find("shots of light"), std::string::npos) << one.err;
  const ReferenceTable a(folder / "one.csv"), b(folder / "all.csv");
  double less = 0.0, more = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    less += a.number(i, "reflected_lux"), more += b.number(i, "reflected_lux");
  }
  EXPECT_LT(less, more);
}

TEST(RoomLight, AWayOfReflectionThatDoesNotExistIsNamed) {
  const fs::path folder = test_folder();
  write_sensors(folder);
  const auto run = run_tenku(
      "illuminance " + kRoomModel + kRoomLight + " --reflection radiocity --out room.csv", folder);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("radiosity"), std::string::npos) << run.err;
}

TEST(RoomLight, LampsInMirrorsThatPathsMeetByChanceAreToldOf) {
  const fs::path folder = test_folder();
  write_sensors(folder);
  const std::string box = TENKU_SOURCE_DIR "/scenes/verification/cornell_box/";
  // A wall that mirrors: paths meet the lamp in it by chance.
  std::ifstream plain(box + "materials.toml");
  std::ofstream(folder / "mirrored.toml") << plain.rdbuf() << "\n[mirror_wall]\nmirror = 0.5\n";
  std::ifstream model(box + "cornell_box.obj");
  std::ofstream(folder / "box.obj")
      << model.rdbuf() << "\nv 0 0 9\nv 1 0 9\nv 0 1 9\nusemtl mirror_wall\nf -3 -2 -1\n";
  const std::string lit =
      "illuminance box.obj --materials mirrored.toml --sky none --tolerance 50 "
      "--sensors room.pts --out ";
  const auto paths = run_tenku(lit + "paths.csv --reflection paths --bounces 1", folder);
  EXPECT_NE(paths.err.find("in mirrors by chance"), std::string::npos) << paths.err;
  const auto none = run_tenku(lit + "none.csv --bounces 0", folder);
  EXPECT_EQ(none.err.find("in mirrors by chance"), std::string::npos) << none.err;
  const auto without = run_tenku("illuminance " + box + "cornell_box.obj --materials " + box +
                                     "materials.toml --sky none --tolerance 50 --sensors room.pts "
                                     "--reflection paths --bounces 1 --out without.csv",
                                 folder);
  EXPECT_EQ(without.err.find("in mirrors by chance"), std::string::npos) << without.err;
  const auto daylit =
      run_tenku("illuminance " + kRoomModel + kRoomLight +
                    " --tolerance 20 --reflection paths --bounces 1 --out daylit.csv",
                folder);
  EXPECT_EQ(daylit.err.find("in mirrors by chance"), std::string::npos) << daylit.err;
}

}  // namespace
}  // namespace tenku
