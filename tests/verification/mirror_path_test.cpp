// Paths that meet nothing but mirrors.
#include <gtest/gtest.h>

#include <cmath>

#include "support/test_scene.h"

namespace tenku {
namespace {

Material pure_mirror() {
  Material material = testing_support::black_material();
  material.name = "mirror";
  material.mirror = 1.0;
  return material;
}

void expect_no_reflected_light(const testing_support::TestScene& scene, const char* name) {
  const auto source = testing_support::source_of(*testing_support::numbered_sky(16, 40, 180));
  Sensors sensors;
  sensors.position = {{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
  sensors.normal = {kZenith, {1, 0, 0}};
  auto options = testing_support::direct_options(2.0);
  options.bounces = 50;
  const auto result = illuminate(scene, sensors, source, options);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    EXPECT_TRUE(std::isfinite(result.values.total_lux(i))) << name << " " << i;
    EXPECT_TRUE(std::isfinite(result.values.error_lux[i])) << name << " " << i;
    EXPECT_EQ(result.values.reflected_lux[i], 0.0) << name << " " << i;  // no surface is diffuse
  }
}

TEST(MirrorPath, CaughtInABoxOfPureMirrorsEnds) {
  testing_support::TestScene scene;
  scene.materials[0] = pure_mirror();
  scene.box({0, 0, 0}, {1, 1, 1});
  expect_no_reflected_light(scene, "box");
}

TEST(MirrorPath, BetweenTwoPureMirrorsEnds) {
  testing_support::TestScene scene;
  scene.materials[0] = pure_mirror();
  scene.wall({0, -100, 0, 100}, -100, 100);
  scene.wall({1, 100, 1, -100}, -100, 100);
  expect_no_reflected_light(scene, "two");
}

}  // namespace
}  // namespace tenku
