// Lamps in pictures by paths: against a closed form, shadows where geometry has them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "support/test_scene.h"
#include "view/view_render.h"

namespace tenku {
namespace {

using namespace testing_support;

constexpr double kExitance = 1000.0, kHeight = 2.0, kHalf = 0.05;
constexpr int kSide = 64;

/// A black floor of 4 x 4 m about the origin, a lamp of 10 x 10 cm over it, and a level board
/// 1 m high over all that has x > 0 and y > 0.
TestScene lamp_over_floor() {
  TestScene scene;
  Material lamp = black_material();
  lamp.emission_lm_m2 = Rgb::grey(kExitance);
  scene.materials.push_back(lamp);
  scene.level({-2, -2, 2, 2}, 0);
  scene.begin_object();
  scene.level({-kHalf, -kHalf, kHalf, kHalf}, kHeight, 1);
  scene.begin_object();
  scene.level({0, 0, 3, 3}, 1);
  return scene;
}

/// Of a small lamp right above, on the floor at a distance: E = M A cos^4 / (pi h^2); its size
/// changes that by less than (kHalf / kHeight)^2.
double open_lux(double away) {
  const double square = kHeight * kHeight + away * away;
  return kExitance * 4.0 * kHalf * kHalf * kHeight * kHeight / (kPi * square * square);
}

Vec3 on_floor(const PerspectiveCamera& camera, double column, double row) {
  const Vec3 ray = camera.ray(column, row);
  return camera.eye() + (-camera.eye().z / ray.z) * ray;
}

TEST(PictureByPaths, HasTheLightOfLampsPixelByPixel) {
  const TestScene scene = lamp_over_floor();
  const Engines engines(scene.soup, scene.materials);
  ViewRequest request;
  request.view = {{-0.5, -0.5, 0.9}, {-0.5, -0.5, 0.0}, Angle::degrees(120.0), kSide, kSide};
  request.tolerance_pct = 3.0;
  request.bounces = 1;
  Progress quiet;
  const RenderedView view = render_view(request, engines, DaylightSource{}, nullptr, quiet);
  const PerspectiveCamera camera(request.view);
  double worst = 0.0;
  std::size_t lit = 0, dark = 0, inside = 0;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const Vec3 at = on_floor(camera, column + 0.5, row + 0.5);
      if (std::max(std::abs(at.x), std::abs(at.y)) > 1.9) continue;
      const auto k = static_cast<std::size_t>(row * kSide + column);
      // The board's edges throw their shadows on themselves, 5 cm wide on either side; a pixel is
      // up to 6 cm.
      const double from_edge = std::min(at.x, at.y);
      if (from_edge > 0.12) {
        EXPECT_EQ(view.illuminance_lux[k], 0.0) << at.x << " " << at.y;
        ++dark;
      } else if (from_edge < -0.12) {
        // The point of the pixel that is lit lies anywhere in it.
        double low = open_lux(std::hypot(at.x, at.y)), high = low;
        for (const int corner : {0, 1, 2, 3}) {
          const Vec3 there = on_floor(camera, column + corner % 2, row + corner / 2);
          low = std::min(low, open_lux(std::hypot(there.x, there.y)));
          high = std::max(high, open_lux(std::hypot(there.x, there.y)));
        }
        const double lux = view.illuminance_lux[k], error = view.error_lux[k];
        worst = std::max({worst, lux / high - 1.0, 1.0 - lux / low});
        inside += lux >= low - error && lux <= high + error;
        ++lit;
      }
    }
  }
  std::printf("[ MEASURED ] lamp by paths: worst %.2f %% of %zu lit pixels\n", 100.0 * worst, lit);
  EXPECT_GT(lit, 300U);
  EXPECT_GT(dark, 50U);
  EXPECT_LE(worst, 0.05);
  EXPECT_GE(static_cast<double>(inside), 0.95 * static_cast<double>(lit));
}

// A pixel of which half the rays meet one material and half another, in one plane of one object,
// shows the mean of both: M / pi of a diffuse surface with exitance M.
TEST(PictureByPaths, MaterialsOfOnePlaneAreToldApartInsideAPixel) {
  TestScene scene;
  for (const double exitance : {1000.0, 3000.0}) {
    Material shining = black_material();
    shining.emission_lm_m2 = Rgb::grey(exitance);
    scene.materials.push_back(shining);
  }
  scene.level({-2, -2, 0, 2}, 0, 1);
  scene.level({0, -2, 2, 2}, 0, 2);
  const Engines engines(scene.soup, scene.materials);
  ViewRequest request;
  constexpr int kColumns = 9;  // the border runs through the middle of the fifth
  request.view = {{0, 0, 1}, {0, 0, 0}, Angle::degrees(60.0), kColumns, kColumns};
  request.bounces = 0;
  Progress quiet;
  const RenderedView view = render_view(request, engines, DaylightSource{}, nullptr, quiet);
  const auto shown = [&](int column) {
    return view.luminance.pixels[static_cast<std::size_t>(4 * kColumns + column)].g;
  };
  EXPECT_NEAR(shown(3), 1000.0 / kPi, 1e-3);
  EXPECT_NEAR(shown(4), 2000.0 / kPi, 1e-3);
  EXPECT_NEAR(shown(5), 3000.0 / kPi, 1e-3);
}

}  // namespace
}  // namespace tenku
