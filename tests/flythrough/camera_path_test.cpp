#include "flythrough/camera_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace tenku {
namespace {

CameraPathRequest request_of(std::vector<CameraKey> keys) {
  CameraPathRequest request;
  request.keys = std::move(keys);
  request.width = 64, request.height = 48;
  request.frames_per_s = 10.0;
  return request;
}

CameraKey key(double time_s, Vec3 eye) { return {time_s, eye, eye + Vec3{0, 5, 0}}; }

TEST(CameraPath, FramesLieEvenlyOnAStraightLine) {
  CameraPathRequest request = request_of({key(1, {0, 0, 2}), key(3, {4, 0, 2})});
  request.curve = PathCurve::Straight;
  const CameraPath path = make_camera_path(request);
  ASSERT_EQ(path.size(), 20U);  // 2 s at 10 frames/s
  for (std::size_t f = 0; f < path.size(); ++f) {
    EXPECT_NEAR(path.frames[f].time_s, 1.0 + 0.1 * static_cast<double>(f), 1e-12);
    EXPECT_NEAR(path.frames[f].eye.x, 0.2 * static_cast<double>(f), 1e-12);
    EXPECT_NEAR(path.frames[f].target.y, 5.0, 1e-12);
  }
}

TEST(CameraPath, CatmullRomPassesThroughItsKeysAtTheirTimes) {
  const std::vector<CameraKey> keys{key(0, {0, 0, 1}), key(1, {10, 0, 2}), key(3, {12, 8, 2}),
                                    key(4, {0, 9, 5})};
  const CameraPath path = make_camera_path(request_of(keys));
  for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
    const auto f = static_cast<std::size_t>(std::lround(10.0 * keys[k].time_s));
    EXPECT_LT(length(path.frames[f].eye - keys[k].eye), 1e-9) << k;
  }
}

// Equal knots on a line make the spline the line itself, evenly run.
TEST(CameraPath, CatmullRomOfEvenKeysOnALineIsTheLine) {
  const CameraPath path = make_camera_path(
      request_of({key(0, {0, 0, 1}), key(1, {3, 3, 1}), key(2, {6, 6, 1}), key(3, {9, 9, 1})}));
  for (const CameraFrame& f : path.frames) {
    EXPECT_NEAR(f.eye.x, 3.0 * f.time_s, 1e-9);
    EXPECT_NEAR(f.eye.y, 3.0 * f.time_s, 1e-9);
  }
}

TEST(CameraPath, ConstantSpeedDoesNotHeedTheTimesBetween) {
  CameraPathRequest request =
      request_of({key(0, {0, 0, 2}), key(0.1, {8, 0, 2}), key(4, {8, 8, 2})});
  request.curve = PathCurve::Straight;
  request.speed = PathSpeed::Constant;
  const CameraPath path = make_camera_path(request);
  for (std::size_t f = 1; f < path.size(); ++f) {
    EXPECT_NEAR(length(path.frames[f].eye - path.frames[f - 1].eye), 16.0 / 40.0, 1e-9) << f;
  }
}

TEST(CameraPath, ConstantSpeedOnACurveIsEvenToOnePercent) {
  CameraPathRequest request =
      request_of({key(0, {0, 0, 2}), key(1, {10, 0, 2}), key(2, {10, 30, 2}), key(4, {60, 30, 9})});
  request.speed = PathSpeed::Constant;
  request.frames_per_s = 200.0;  // chords as long as their arcs
  const CameraPath path = make_camera_path(request);
  const double mean = path.length_m() / static_cast<double>(path.size() - 1);
  for (std::size_t f = 1; f < path.size(); ++f) {
    const double step = length(path.frames[f].eye - path.frames[f - 1].eye);
    EXPECT_NEAR(step, mean, 0.01 * mean) << f;
  }
}

TEST(CameraPath, EasedSpeedIsTheCubicOfItsShareOfTime) {
  CameraPathRequest request = request_of({key(0, {0, 0, 2}), key(2, {10, 0, 2})});
  request.speed = PathSpeed::Eased;
  const CameraPath path = make_camera_path(request);
  for (const CameraFrame& f : path.frames) {
    const double u = f.time_s / 2.0;
    EXPECT_NEAR(f.eye.x, 10.0 * (3 * u * u - 2 * u * u * u), 1e-6);
  }
}

TEST(CameraPath, AWalkKeepsItsHeightAboveTheGround) {
  CameraPathRequest request = request_of({key(0, {0, 0, 0}), key(2, {10, 0, 0})});
  request.walk_height_m = 1.6;
  const CameraPath path = make_camera_path(
      request, [](double x, double) { return std::optional<double>(0.1 * x * x); });
  for (const CameraFrame& f : path.frames) {
    EXPECT_NEAR(f.eye.z, 0.1 * f.eye.x * f.eye.x + 1.6, 1e-9);
    EXPECT_NEAR(f.target.z, f.eye.z, 1e-9);
  }
}

TEST(CameraPath, AStandingCameraHasItsSeconds) {
  CameraPathRequest request = request_of({key(0, {1, 2, 3})});
  EXPECT_EQ(make_camera_path(request).size(), 1U);
  request.standing_s = 1.5;
  const CameraPath path = make_camera_path(request);
  EXPECT_EQ(path.size(), 15U);
  EXPECT_EQ(path.frames.back().eye, (Vec3{1, 2, 3}));
}

TEST(CameraPath, WhatIsNoPathIsRefused) {
  EXPECT_THROW(make_camera_path(request_of({})), InputError);
  EXPECT_THROW(make_camera_path(request_of({key(1, {0, 0, 0}), key(1, {1, 0, 0})})), InputError);
  EXPECT_THROW(make_camera_path(request_of({key(0, {0, 0, 0}), key(1e9, {1, 0, 0})})), InputError);
  EXPECT_THROW(make_camera_path(request_of({{0, {1, 1, 1}, {1, 1, 1}}})), InputError);
  CameraPathRequest walk = request_of({key(0, {0, 0, 0}), key(1, {1, 0, 0})});
  walk.walk_height_m = 1.6;
  EXPECT_THROW(make_camera_path(walk), InputError);
}

}  // namespace
}  // namespace tenku
