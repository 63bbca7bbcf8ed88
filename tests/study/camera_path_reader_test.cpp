#include "study/camera_path_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>

#include "core/error.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

class CameraPathFile : public testing::Test {
 protected:
  CameraPathFile()
      : folder_(fs::path(testing::TempDir()) /
                (std::string("tenku_path_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~CameraPathFile() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  std::string refusal(const std::string& text) const {
    try {
      read_camera_path(write("path.toml", text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  fs::path folder_;
};

constexpr const char* kKey = "[[key]]\ntime_s = 0\neye = [1, 2, 3]\ntarget = [4, 5, 6]\n";

TEST_F(CameraPathFile, ReadsWhatItSaysAndHasDefaults) {
  const auto request = read_camera_path(write(
      "path.toml", std::string("curve = \"straight\"\nspeed = \"eased\"\nframes_per_second = 24\n"
                               "size = [640, 360]\nfov_deg = 50\n") +
                       kKey + "[[key]]\ntime_s = 2\neye = [7, 8, 9]\ntarget = [1, 1, 1]\n" +
                       "fov_deg = 35\n"));
  EXPECT_EQ(request.curve, PathCurve::Straight);
  EXPECT_EQ(request.speed, PathSpeed::Eased);
  EXPECT_EQ(request.frames_per_s, 24.0);
  EXPECT_EQ(request.width, 640);
  ASSERT_EQ(request.keys.size(), 2U);
  EXPECT_EQ(request.keys[0].eye, (Vec3{1, 2, 3}));
  EXPECT_NEAR(request.keys[0].horizontal_fov.in_degrees(), 50.0, 1e-12);
  EXPECT_NEAR(request.keys[1].horizontal_fov.in_degrees(), 35.0, 1e-12);
  const auto plain = read_camera_path(write("path.toml", kKey));
  EXPECT_EQ(plain.curve, PathCurve::CatmullRom);
  EXPECT_EQ(plain.frames_per_s, 30.0);
  EXPECT_EQ(plain.height, 720);
  EXPECT_FALSE(plain.walk_height_m.has_value());
}

TEST_F(CameraPathFile, RefusesByLineAndName) {
  EXPECT_NE(refusal(std::string("curv = \"straight\"\n") + kKey).find("curve"), std::string::npos);
  EXPECT_NE(refusal(std::string(kKey) + "fov_deg = 400\n").find("path.toml:5"), std::string::npos);
  EXPECT_NE(refusal("[[key]]\ntime_s = 0\neye = [1, 2, 3]\n").find("target"), std::string::npos);
  EXPECT_NE(refusal("fov_deg = 60\n").find("[[key]]"), std::string::npos);
  EXPECT_NE(refusal("size = [640.5, 360]\n" + std::string(kKey)).find("whole"), std::string::npos);
  EXPECT_THROW(read_camera_path("/nowhere/path.toml"), InputError);
}

// A terrain that rises by one in ten to the east, with a flat roof over a part of it.
TEST_F(CameraPathFile, AWalkGoesOverTheGroundAndUnderRoofs) {
  const fs::path scene = write(
      "hill.obj",
      "o hill\nv 0 -20 0\nv 100 -20 10\nv 100 20 10\nv 0 20 0\nf 1 2 3 4\n"
      "o roof\nv 40 -9 20\nv 60 -9 20\nv 60 9 20\nv 40 9 20\nv 40 -9 21\nv 60 -9 21\nv 60 9 21\n"
      "v 40 9 21\nf 8 7 6 5\n");
  const fs::path materials = write("m.toml", "[hill]\nreflectance = 0.3\n");
  Progress quiet;
  const LitScene lit(
      scene, {},
      [](const auto&) {
        SkyRequest none;
        none.model = "none";
        return make_sky(none);
      },
      std::nullopt, GlPlatform::Auto, quiet);
  CameraPathRequest request;
  request.keys = {{0.0, {5, 0, 50}, {100, 0, 50}}, {9.0, {35, 0, -4}, {100, 0, 8}}};
  request.walk_height_m = 1.6;
  request.curve = PathCurve::Straight;
  const CameraPath path = camera_path_in(request, lit);
  for (const CameraFrame& f : path.frames) {
    const Vec3 in_file = lit.scene().frame.to_file(f.eye);
    EXPECT_NEAR(in_file.z, 0.1 * in_file.x + 1.6, 1e-3);
  }
  request.keys[0].eye = {-50, 0, 2};
  EXPECT_THROW(camera_path_in(request, lit), InputError);
}

/// First columns of the table that begins with `curve`.
std::vector<std::string> documented_keys() {
  std::ifstream in(fs::path(TENKU_SOURCE_DIR) / "docs/flythrough.md");
  const std::regex name("`([a-z_.]+)`");
  std::vector<std::string> keys;
  std::string line;
  while (std::getline(in, line)) {
    if (keys.empty() && !line.starts_with("| `curve`")) continue;
    if (!line.starts_with("| `")) break;
    const std::string column = line.substr(0, line.find(" |", 2));
    for (std::sregex_iterator it(column.begin(), column.end(), name), end; it != end; ++it) {
      keys.push_back((*it)[1]);
    }
  }
  return keys;
}

TEST(CameraPathDocumentation, HasEveryKeyAndNoOther) {
  EXPECT_EQ(documented_keys(), camera_path_keys());
}

}  // namespace
}  // namespace tenku
