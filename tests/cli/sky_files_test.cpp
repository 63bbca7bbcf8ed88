// The sky as mesh and pictures: `tenku sky --out F.vtp|.hdr|.exr|.png`.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "output/field_writer.h"
#include "pictures/picture_codec.h"
#include "study/sky_output.h"
#include "support/picture_channel.h"
#include "support/run_program.h"

namespace tenku {
namespace {

using testing_support::channel;
using testing_support::run_tenku;
using testing_support::test_folder;

const std::vector<double>& values_named(const FieldMesh& mesh, std::string_view name) {
  for (const FieldValues& field : mesh.cell_values) {
    if (field.name == name) return field.values;
  }
  throw std::runtime_error("no such array");
}

/// Twice the area of a flat polygon as a vector, right-handed about its corners.
Vec3 area_vector(const FieldMesh& mesh, std::uint32_t begin, std::uint32_t end) {
  Vec3 sum;
  for (std::uint32_t k = begin; k < end; ++k) {
    const std::uint32_t next = k + 1 < end ? k + 1 : begin;
    sum =
        sum + cross(mesh.points[mesh.polygon_corners[k]], mesh.points[mesh.polygon_corners[next]]);
  }
  return sum;
}

// Tregenza's 145 patches cover a hemisphere: 2 pi sr, and pi L on the ground for a uniform sky.
TEST(SkyFiles, ElementsAreADomeOfRadiusOneThatLooksInward) {
  const auto folder = test_folder();
  const auto run = run_tenku(
      "sky --sky uniform --sky-illuminance 10000 --partition tregenza --out sky.vtp", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const FieldMesh mesh = read_vtp(folder / "sky.vtp");
  ASSERT_EQ(mesh.polygon_count(), 145u);
  double solid_angle = 0.0, lux = 0.0;
  for (std::size_t k = 0; k < 145; ++k) {
    EXPECT_NEAR(values_named(mesh, "luminance_cd_m2")[k], 10000.0 / kPi, 1e-3);
    solid_angle += values_named(mesh, "solid_angle_sr")[k];
    lux += values_named(mesh, "illuminance_lux")[k];
    const std::uint32_t begin = k == 0 ? 0 : mesh.polygon_ends[k - 1];
    const Vec3 corner = mesh.points[mesh.polygon_corners[begin]];
    EXPECT_LT(dot(area_vector(mesh, begin, mesh.polygon_ends[k]), corner), 0.0) << k;
  }
  EXPECT_NEAR(solid_angle, 2.0 * kPi, 1e-5);  // stored as floats
  EXPECT_NEAR(lux, 10000.0, 0.02);
  for (const Vec3 point : mesh.points) EXPECT_NEAR(length(point), 1.0, 1e-6);
}

// The brightest polygon of a clear sky is where the sun is: south-east, 40 degrees up.
TEST(SkyFiles, BrightestElementIsAtTheSun) {
  const auto folder = test_folder();
  const auto run =
      run_tenku("sky --sky cie:12 --sun-altitude 40 --sun-azimuth 135 --out sky.vtp", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const FieldMesh mesh = read_vtp(folder / "sky.vtp");
  const auto& luminance = values_named(mesh, "luminance_cd_m2");
  const auto k = static_cast<std::size_t>(std::max_element(luminance.begin(), luminance.end()) -
                                          luminance.begin());
  const Vec3 corner = mesh.points[mesh.polygon_corners[mesh.polygon_ends[k] - 1]];
  const Vec3 sun = direction_from(Angle::degrees(135.0), Angle::degrees(40.0));
  EXPECT_LT(angle_between(corner, sun).in_degrees(), 10.0);
}

/// Column and row of the largest value in the green channel.
std::pair<int, int> brightest(const StoredPicture& picture) {
  const std::vector<float> green = channel(picture, "G");
  const auto at = std::max_element(green.begin(), green.end());
  const auto i = static_cast<int>(at - green.begin());
  return {i % picture.header.width, i / picture.header.width};
}

// Azimuth 135: a turn of 135 degrees to the right of the middle, 7/8 of the width. Altitude 40:
// 50 of 180 degrees down.
TEST(SkyFiles, PanoramaHasNorthInTheMiddleAndEastToItsRight) {
  const auto folder = test_folder();
  for (const std::string name : {"sky.hdr", "sky.exr"}) {
    const auto run =
        run_tenku("sky --sky cie:12 --sun-altitude 40 --sun-azimuth 135 --out " + name, folder);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const StoredPicture picture = picture_codec().read(folder / name);
    ASSERT_EQ(picture.header.width, 2 * picture.header.height);
    const auto [column, row] = brightest(picture);
    EXPECT_NEAR((column + 0.5) / picture.header.width, 7.0 / 8.0, 0.005) << name;
    EXPECT_NEAR((row + 0.5) / picture.header.height, 50.0 / 180.0, 0.01) << name;
  }
}

// Read back as a sky, the picture has the zenith luminance and the illuminance of the model.
TEST(SkyFiles, PanoramaReadsBackAsTheSameSky) {
  const auto folder = test_folder();
  const std::string sun = " --sun-altitude 40 --sun-azimuth 135 --sun-illuminance 0";
  const auto made = run_tenku(
      "sky --sky cie:12 --sky-illuminance 10000 --out sky.exr --json --quiet" + sun, folder);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto read =
      run_tenku("sky --sky image:sky.exr --sky-illuminance 10000 --json --quiet" + sun, folder);
  ASSERT_EQ(read.exit_code, 0) << read.err;
  const auto a = nlohmann::json::parse(made.out), b = nlohmann::json::parse(read.out);
  const double zenith = a["zenith_luminance_cd_m2"].get<double>();
  EXPECT_NEAR(b["zenith_luminance_cd_m2"].get<double>(), zenith, 0.005 * zenith);
}

TEST(SkyFiles, PlanHasNorthUpAndEastToTheRight) {
  SkyRequest request;
  request.model = "cie:12";
  request.sun = SunInSky{direction_from(Angle::degrees(90.0), Angle::degrees(30.0)), {}, {}};
  request.sun_illuminance = Illuminance(0.0);  // no ring over the spot
  const Image8 plan = sky_plan(make_sky(request), 300);
  // Yellow, the top of the scale, has the most red and green: 2/3 of the radius to the east.
  const auto light_at = [&](int column, int row) {
    const Rgb8 c = plan.at(30 + column, 30 + row);
    return c.r + c.g;
  };
  EXPECT_GT(light_at(250, 150), 350);
  EXPECT_LT(light_at(50, 150), 250);   // west
  EXPECT_LT(light_at(150, 50), 250);   // north
  EXPECT_LT(light_at(150, 250), 250);  // south
}

TEST(SkyFiles, PictureOfTheProgramIsThePlan) {
  const auto folder = test_folder();
  const auto run =
      run_tenku("sky --sky cie:12 --sun-altitude 40 --sun-azimuth 135 --out sky.png", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const StoredPicture picture = picture_codec().read(folder / "sky.png");
  EXPECT_EQ(picture.header.width, 700);
  EXPECT_GT(picture.header.height, 760);  // the legend
}

TEST(SkyFiles, NightAndNoSkyAreRefusedWithAReason) {
  const auto folder = test_folder();
  for (const std::string out : {"sky.vtp", "sky.png", "sky.hdr"}) {
    const auto run = run_tenku("sky --sky none --out " + out, folder);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_NE(run.err.find("no sky"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / out));
  }
}

}  // namespace
}  // namespace tenku
