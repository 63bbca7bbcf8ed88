// Which parts of a scene may have sky below them.
#include "visibility/floating_parts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/test_scene.h"
#include "visibility/ray_visibility.h"
#include "visibility/slice_tracer.h"

namespace tenku {
namespace {

using testing_support::TestScene;

/// Upright prism about the origin between two heights, its radii at both: closed, of the object
/// last begun.
void prism(TestScene& scene, Vec3 foot, double radius_below, double radius_above, double height) {
  constexpr int kSides = 8;
  const auto at = [&](int k, double radius, double up) {
    const double angle = 2.0 * kPi * k / kSides;
    return foot + Vec3{radius * std::cos(angle), radius * std::sin(angle), up};
  };
  for (int k = 0; k < kSides; ++k) {
    scene.quad(at(k, radius_below, 0.0), at(k + 1, radius_below, 0.0),
               at(k + 1, radius_above, height), at(k, radius_above, height));
    scene.quad(foot, at(k + 1, radius_below, 0.0), at(k, radius_below, 0.0), foot);
    const Vec3 top = foot + Vec3{0.0, 0.0, height};
    scene.quad(top, at(k, radius_above, height), at(k + 1, radius_above, height), top);
  }
}

std::vector<std::uint32_t> seen_from(const TestScene& scene, Vec3 origin) {
  const RayVisibility rays(scene.soup, scene.materials);
  std::vector<std::uint32_t> found;
  rays.floating_parts().around(origin, 100, SliceTracer::kLeastPart_rad, found);
  return found;
}

TEST(FloatingParts, WhatStandsOnTheGroundIsNone) {
  TestScene scene;
  scene.level({-50, -50, 50, 50}, 0.0);
  scene.box({5, 5, 0}, {4, 4, 10});
  scene.box({-15, 5, 0}, {4, 4, 3}, 30.0);
  EXPECT_TRUE(seen_from(scene, {0, 0, 0.01}).empty());
}

TEST(FloatingParts, AHillIsNone) {
  TestScene scene;
  scene.quad({-50, -50, 0}, {50, -50, 0}, {50, 0, 20}, {-50, 0, 20});
  scene.quad({-50, 0, 20}, {50, 0, 20}, {50, 50, 0}, {-50, 50, 0});
  EXPECT_TRUE(seen_from(scene, {0, -40, 4.1}).empty());
}

TEST(FloatingParts, WhatHangsInTheAirIsOneFromBelowAlone) {
  TestScene scene;
  scene.level({-50, -50, 50, 50}, 0.0);
  scene.box({5, 5, 6}, {4, 4, 1});
  EXPECT_EQ(seen_from(scene, {0, 0, 0.01}).size(), 1U);
  EXPECT_TRUE(seen_from(scene, {0, 0, 6.5}).empty());  // its bottom is below the horizon
  EXPECT_TRUE(seen_from(scene, {0, 0, 20.0}).empty());
  EXPECT_TRUE(seen_from(scene, {3000.0, 0, 0.01}).empty());  // too small
}

TEST(FloatingParts, ACrownOnItsTrunkIsOne) {
  TestScene scene;
  scene.level({-50, -50, 50, 50}, 0.0);
  scene.begin_object();
  prism(scene, {10, 0, 0}, 0.2, 3.0, 6.0);
  EXPECT_EQ(seen_from(scene, {0, 0, 0.01}).size(), 1U);
}

TEST(FloatingParts, ACrownOfFacesThatAreObjectsIsOne) {
  TestScene scene;
  scene.level({-50, -50, 50, 50}, 0.0);
  scene.begin_object();
  prism(scene, {10, 0, 0}, 0.2, 3.0, 6.0);
  for (std::size_t t = 0; t < scene.soup.size(); ++t) {
    scene.soup.object[t] = static_cast<std::uint32_t>(t);
  }
  EXPECT_EQ(seen_from(scene, {0, 0, 0.01}).size(), 1U);
}

TEST(FloatingParts, TheLargestAreTaken) {
  TestScene scene;
  scene.level({-200, -200, 200, 200}, 0.0);
  for (int k = 0; k < 20; ++k) scene.box({10.0 + 8.0 * k, 0, 5}, {2, 2, 1});
  const RayVisibility rays(scene.soup, scene.materials);
  std::vector<std::uint32_t> found;
  rays.floating_parts().around({0, 0, 0.01}, 3, SliceTracer::kLeastPart_rad, found);
  ASSERT_EQ(found.size(), 3U);
  std::sort(found.begin(), found.end());  // from west to east
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(rays.floating_parts()[found[k]].middle.x, 11.0 + 8.0 * static_cast<double>(k),
                1e-9);
  }
}

}  // namespace
}  // namespace tenku
