#include "flythrough/playback.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "core/random.h"
#include "flythrough/floor_store.h"
#include "flythrough/page_points.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;

constexpr double kKept = 3.4e-4;  // the share to which a store keeps light, by its description

class Playback : public testing::Test {
 protected:
  Playback()
      : file_(fs::path(testing::TempDir()) /
              (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
               ".tkpts")) {}
  ~Playback() override { fs::remove(file_); }
  fs::path file_;
};

// Where a pixel looks at the floor, in the open or over the horizon its luminance is known.
TEST_F(Playback, PixelsHaveTheLuminanceOfLambertsLaw) {
  write_floor_store(file_);
  const PointStore store(file_);
  FramePlayer player(store, {});
  const Image image = player.frame(2);
  const PerspectiveView view = player.view(2);
  const PerspectiveCamera camera(view);
  std::size_t floor = 0, sky = 0, below = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Vec3 ray = camera.ray(x + 0.5, y + 0.5);
      const Rgb c = image.at(x, y);
      if (ray.z > 0.02) {
        EXPECT_NEAR(c.g, kSkyLuminance, kKept * kSkyLuminance) << x << ' ' << y;
        ++sky;
        continue;
      }
      if (ray.z > -0.02) continue;
      const Vec3 at = view.eye - (view.eye.z / ray.z) * ray;
      const double half = 2.0 * camera.footprint_m(length(at - view.eye)) / -ray.z;
      const auto in = [&](double u) { return std::abs(u - std::round(u)) > half; };
      if (at.y > 14.0 + half) {
        EXPECT_NEAR(c.b, kBelow, 0.01);
        ++below;
      } else if (at.y < 14.0 - half && std::abs(at.x) < 6.0 - half && in(at.x) && in(at.y)) {
        const double reflectance = is_light_square(at.x, at.y) ? kLightFloor : kDarkFloor;
        EXPECT_NEAR(c.r, reflectance * kFloorLux / kPi, kKept * reflectance * kFloorLux)
            << x << ' ' << y;
        ++floor;
      }
    }
  }
  EXPECT_GT(floor, 100U);  // there is something to compare
  EXPECT_GT(sky, 100U);
  EXPECT_GT(below, 20U);
}

TEST_F(Playback, LittleMemoryShowsTheSameFrames) {
  write_floor_store(file_);
  const PointStore store(file_);
  FramePlayer ample(store, {}), scant(store, {.points_in_memory = 1});
  for (const std::size_t frame : {0U, 5U, 0U}) {
    EXPECT_EQ(ample.frame(frame).pixels, scant.frame(frame).pixels);
  }
}

TEST_F(Playback, ALargerPictureHasNoHoles) {
  write_floor_store(file_);
  const PointStore store(file_);
  FramePlayer player(store, {.width = 256});
  const Image image = player.frame(0);
  ASSERT_EQ(image.height, 192);
  const PerspectiveCamera camera(player.view(0));
  const Vec3 eye = camera.eye();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Vec3 ray = camera.ray(x + 0.5, y + 0.5), at = eye - (eye.z / ray.z) * ray;
      if (ray.z > -0.02 || at.y > 13.0 || std::abs(at.x) > 5.8) continue;
      // The darker square's blue and the lighter one's; `kBelow` lies between them.
      const double dark = kDarkFloor * kFloorLux / kPi, light = 0.5 * kLightFloor * kFloorLux / kPi;
      const double share = (image.at(x, y).r - dark) / (2.0 * light - dark);
      EXPECT_NEAR(image.at(x, y).b, dark + share * (light - dark), 1.0) << x << ' ' << y;
    }
  }
}

TEST_F(Playback, AStoreThatIsCutOffPlaysWhatItHas) {
  write_floor_store(file_, 3);
  EXPECT_EQ(FramePlayer(PointStore(file_), {}).frames(), 3U);
  write_floor_store(file_, 0);
  const PointStore none(file_);
  EXPECT_THROW(FramePlayer(none, {}), InputError);
}

TEST_F(Playback, ALightingThatIsNotThereIsRefused) {
  write_floor_store(file_);
  const PointStore store(file_);
  EXPECT_THROW(FramePlayer(store, {.lighting = 2}), InputError);
}

TEST_F(Playback, AFrameWithNothingInItShowsTheSky) {
  StoreHeader header = floor_header();
  for (CameraFrame& frame : header.path.frames) frame.target = frame.eye + Vec3{0.0, 0.1, 1.0};
  {
    PointStoreWriter store(file_, header);
    store.add_lighting(even_sky(""));
    store.end_frames(6);
  }
  const PointStore store(file_);
  FramePlayer player(store, {});
  for (const Rgb& pixel : player.frame(3).pixels)
    EXPECT_NEAR(pixel.r, kSkyLuminance, kKept * kSkyLuminance);
}

// Codes by the definition of EXT_texture_shared_exponent: white is 256 / 2^9 * 2^(16 - 15).
TEST(SharedExponent, CodesAreThoseOfTheExtension) {
  EXPECT_EQ(shared_exponent_code(Rgb::grey(1.0)), 0x84020100U);
  EXPECT_EQ(shared_exponent_code({}), 0U);
  EXPECT_EQ(shared_exponent_code({65408.0, 0.0, 0.0}), 0xf80001ffU);
  EXPECT_NE(shared_exponent_code(Rgb::grey(1e9)), kNoColourCode);
  EXPECT_EQ(colour_of_shared_exponent(0x84020100U), Rgb::grey(1.0));
}

TEST(SharedExponent, ComesBackWithinItsError) {
  SampleRandom random(7, 0, 0);
  for (int k = 0; k < 10'000; ++k) {
    const double scale = std::exp2(30.0 * random.uniform() - 15.0);
    const Rgb c{scale * random.uniform(), scale * random.uniform(), scale * random.uniform()};
    const Rgb back = colour_of_shared_exponent(shared_exponent_code(c));
    const double most = std::max({c.r, c.g, c.b}), least_step = std::exp2(-25.0);
    for (const double off : {c.r - back.r, c.g - back.g, c.b - back.b}) {
      EXPECT_LE(std::abs(off), 0.002 * most + least_step);
    }
  }
}

TEST(PagePoints, BlocksHoldAllPointsInFewBytes) {
  const StoredPoints points = floor_points();
  const PagePoints page = page_points(points);
  std::size_t count = 0;
  for (const PageBlock& block : page.blocks) {
    count += block.points;
    EXPECT_LT(block.step.x, 0.05 / 64.0);
  }
  EXPECT_EQ(count, points.size());
  EXPECT_LE(page.bytes.size(), 16 * points.size());
}

}  // namespace
}  // namespace tenku
