// tenku flythrough from end to end: a store, what is in it, other hours, other programs.
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "cli/lit_scene_files.h"
#include "output/field_writer.h"
#include "support/run_program.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;
using nlohmann::json;

class FlyThroughProgram : public testing::Test {
 protected:
  FlyThroughProgram() : folder(test_folder()) {
    write_box_scene(folder);
    write_text(folder / "p.toml",
               "frames_per_second = 4\nsize = [48, 32]\n"
               "[[key]]\ntime_s = 0\neye = [6, -6, 3]\ntarget = [0, 0, 0]\n"
               "[[key]]\ntime_s = 1\neye = [7, -4, 3]\ntarget = [0, 0, 0]\n");
  }
  ProgramRun fly(const std::string& more) const {
    return run_tenku("flythrough box.obj --path p.toml --bounces 0" + kSky + more, folder);
  }
  fs::path folder;
};

TEST_F(FlyThroughProgram, WritesAStoreThatInspectReads) {
  const auto run = fly(" --out f.tkpts --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json summary = json::parse(run.out);
  EXPECT_EQ(summary["frames"], 4);
  EXPECT_FALSE(fs::exists(folder / "f.tkpts.part"));
  const auto told = run_tenku("inspect f.tkpts --json", folder);
  ASSERT_EQ(told.exit_code, 0) << told.err;
  const json store = json::parse(told.out);
  EXPECT_EQ(store["complete"], true);
  EXPECT_EQ(store["points"], summary["points"]);
  EXPECT_EQ(store["path"]["frames_done"], 4);
  EXPECT_EQ(store["scene"], "box.obj");
  EXPECT_NE(run_tenku("inspect f.tkpts", folder).out.find("4 frames of 48x32"), std::string::npos);
}

TEST_F(FlyThroughProgram, AddsAnotherSkyAndGivesPointsToOtherPrograms) {
  ASSERT_EQ(fly(" --out f.tkpts").exit_code, 0);
  const auto run = run_tenku(
      "flythrough --relight f.tkpts --bounces 0 --sky uniform --sky-illuminance 20000 --json",
      folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(json::parse(run.out)["lighting"], 1);
  const auto count = json::parse(run.out)["points"].get<std::size_t>();
  for (const char* name : {"0.vtp", "1.vtp", "1.ply", "1.glb"}) {
    const auto out = run_tenku(
        "flythrough --store f.tkpts --lighting " + std::string(1, name[0]) + " --export " + name,
        folder);
    ASSERT_EQ(out.exit_code, 0) << out.err;
  }
  const FieldMesh a = read_vtp(folder / "0.vtp"), b = read_vtp(folder / "1.vtp");
  ASSERT_EQ(a.points.size(), count);
  const auto sky = [](const FieldMesh& mesh) {
    double sum = 0.0;
    for (const FieldValues& f : mesh.point_values) {
      if (f.name != "sky_lux") continue;
      for (const double v : f.values) sum += v;
    }
    return sum;
  };
  EXPECT_NEAR(sky(b) / sky(a), 2.0, 0.02);  // twice the sky
  const std::string ply = contents_of(folder / "1.ply");
  EXPECT_TRUE(ply.starts_with("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_EQ(ply.size(), ply.find("end_header\n") + 11 + count * (11 * 4 + 3));
  const std::string glb = contents_of(folder / "1.glb");
  std::uint32_t head[5];
  ASSERT_GT(glb.size(), sizeof head);
  std::memcpy(head, glb.data(), sizeof head);
  EXPECT_EQ(head[0], 0x46546C67U);  // glTF 2.0, 4.4.1
  EXPECT_EQ(head[2], glb.size());
  const json gltf = json::parse(glb.substr(20, head[3]));
  EXPECT_EQ(gltf["accessors"][0]["count"], count);
  EXPECT_EQ(gltf["meshes"][0]["primitives"][0]["mode"], 0);
}

TEST_F(FlyThroughProgram, RefusesWhatDoesNotFit) {
  ASSERT_EQ(fly(" --out f.tkpts").exit_code, 0);
  write_text(folder / "box.obj", std::string(kBoxScene) + "# another\n");
  auto run =
      run_tenku("flythrough box.obj --relight f.tkpts --sky uniform --sky-illuminance 5", folder);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("another scene"), std::string::npos) << run.err;
  EXPECT_EQ(fly(" --out f.tkpts --relight f.tkpts").exit_code, 2);
  EXPECT_EQ(fly("").exit_code, 2);
  EXPECT_EQ(run_tenku("inspect box.tkpts", folder).exit_code, 2);
  EXPECT_EQ(run_tenku("flythrough --store f.tkpts --export f.xyz", folder).exit_code, 2);
  EXPECT_EQ(run_tenku("flythrough --store f.tkpts --lighting 7 --export f.ply", folder).exit_code,
            2);
}

TEST_F(FlyThroughProgram, AFullDiskEndsWithOne) {
  const auto run = fly(" --out /dev/full");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("No space left"), std::string::npos) << run.err;
}

TEST_F(FlyThroughProgram, APathThroughAWallIsToldWithItsObject) {
  write_text(folder / "p.toml",
             "frames_per_second = 4\nsize = [16, 12]\ncurve = \"straight\"\n"
             "[[key]]\ntime_s = 0\neye = [5, 0.1, 0.3]\ntarget = [-9, 0, 0]\n"
             "[[key]]\ntime_s = 2\neye = [0, 0.1, 0.3]\ntarget = [-9, 0, 0]\n");
  const auto run = fly(" --out f.tkpts --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  json found;
  for (const json& f : json::parse(run.out)["findings"]) {
    if (f["code"] == "path_through_wall") found = f;
  }
  ASSERT_FALSE(found.is_null()) << run.out;
  EXPECT_EQ(found["object"], "box");
  EXPECT_NE(found["where"].get<std::string>().find("1.60 s"), std::string::npos) << found;
}

}  // namespace
}  // namespace tenku
