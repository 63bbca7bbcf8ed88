// Where shadow maps are known to fail: grazing light, thin walls, walls that coincide, far origins.
#include <gtest/gtest.h>

#include "support/engine_comparison.h"

namespace tenku {
namespace {

using testing_support::TestScene;

constexpr double kLift = 1e-5;  // m

ShadowMapOptions software(int texels, bool square = false) {
  ShadowMapOptions options;
  options.texels = texels;
  options.square_texels = square;
  options.platform = GlPlatform::OsMesa;
  return options;
}

Sensors level_grid(double half, int count, double z) {
  Sensors sensors;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      const double step = 2.0 * half / (count - 1);
      sensors.position.push_back({step * i - half + 0.013, step * j - half + 0.007, z});
      sensors.normal.push_back(kZenith);
    }
  }
  return sensors;
}

std::vector<float> seen_from(const Visibility& engine, Vec3 toward, const Sensors& sensors) {
  std::vector<float> seen(sensors.size());
  engine.transmission_from(toward, sensors.position, sensors.normal, seen);
  return seen;
}

TEST(ShadowStability, GrazingLightLeavesNoAcneOnALargePlane) {
  const Sensors flat = level_grid(1900, 60, -1.0 + kLift);
  for (const bool square : {false, true}) {
    TestScene plane;
    plane.level({-2000, -2000, 2000, 2000}, -1.0);
    for (const int texels : {64, 512}) {
      const ShadowMaps maps(plane.soup, plane.materials, software(texels, square));
      for (const double altitude : {0.3, 1.0, 3.0, 10.0}) {
        for (const double azimuth : {0.0, 33.0, 45.0, 250.0}) {
          const Vec3 toward = direction_from(Angle::degrees(azimuth), Angle::degrees(altitude));
          const auto seen = seen_from(maps, toward, flat);
          EXPECT_EQ(*std::min_element(seen.begin(), seen.end()), 1.0F)
              << altitude << " degrees toward " << azimuth << ", " << texels << " texels";
        }
      }
    }
  }
}

TEST(ShadowStability, AFoldedSurfaceDoesNotShadeItselfWhereTheLightReachesIt) {
  // Two planes that meet in a ridge of 4 degrees and in a valley: rays tell which side is lit.
  TestScene scene;
  for (int k = -10; k < 10; ++k) {
    const double x = 20.0 * k;
    scene.quad({x, -200, 0}, {x + 10, -200, 0.7}, {x + 10, 200, 0.7}, {x, 200, 0});
    scene.quad({x + 10, -200, 0.7}, {x + 20, -200, 0}, {x + 20, 200, 0}, {x + 10, 200, 0.7});
  }
  const RayVisibility rays(scene.soup, scene.materials);
  const ShadowMaps maps(scene.soup, scene.materials, software(512));
  Sensors sensors;
  for (int k = -150; k < 150; ++k) {
    const double x = k + 0.37, in_fold = x - 20.0 * std::floor(x / 20.0);
    const double rise = in_fold < 10 ? 0.07 : -0.07;
    const double z = 0.07 * (in_fold < 10 ? in_fold : 20 - in_fold);
    const Vec3 normal = normalized(Vec3{-rise, 0, 1});
    sensors.position.push_back(Vec3{x, 3.0, z} + kLift * normal);
    sensors.normal.push_back(normal);
  }
  for (const double altitude : {5.0, 10.0}) {  // the slope of 4 degrees is lit all over
    const Vec3 toward = direction_from(Angle::degrees(80), Angle::degrees(altitude));
    for (const float one : seen_from(rays, toward, sensors)) ASSERT_EQ(one, 1.0F);
    for (const float one : seen_from(maps, toward, sensors)) EXPECT_EQ(one, 1.0F) << altitude;
  }
}

TEST(ShadowStability, AThinWallsShadowBeginsAtItsFoot) {
  TestScene scene;
  scene.level({-50, -50, 50, 50}, 0.0);
  scene.wall({-40, 0, 40, 0}, 0, 5);
  const ShadowMaps maps(scene.soup, scene.materials, software(256));
  for (const double altitude : {5.0, 30.0, 60.0}) {
    const Vec3 toward = direction_from(Angle::degrees(0), Angle::degrees(altitude));
    Sensors sensors = level_grid(45, 20, kLift);
    const double texel = maps.texel(toward, sensors.position).height_m;
    // On the ground the height of a texel is longer by 1 / sin(altitude).
    const double two_texels = 2.0 * texel / std::sin(altitude * kPi / 180.0);
    sensors.position.push_back({3.0, -two_texels, kLift});
    sensors.position.push_back({3.0, two_texels, kLift});
    sensors.normal.insert(sensors.normal.end(), 2, kZenith);
    const auto seen = seen_from(maps, toward, sensors);
    EXPECT_EQ(seen[sensors.size() - 2], 0.0F) << "behind the foot, light at " << altitude;
    EXPECT_EQ(seen[sensors.size() - 1], 1.0F) << "before the foot, light at " << altitude;
  }
}

TEST(ShadowStability, WallsThatCoincideShadeLikeOne) {
  TestScene one, two;
  for (TestScene* scene : {&one, &two}) {
    scene->level({-50, -50, 50, 50}, 0.0);
    scene->box({-10, -10, 0}, {10, 20, 12});
    scene->box({0, -10, 0}, {10, 20, 12});  // shares a wall with the first
  }
  two.box({-10, -10, 0}, {10, 20, 12});  // and once more
  two.level({-50, -50, 50, 50}, 0.0);
  const RayVisibility rays(one.soup, one.materials);
  Sensors sensors;
  for (int k = 0; k < 40; ++k) {
    const double t = -9.7 + 0.49 * k;
    const auto add = [&](Vec3 at, Vec3 normal) {
      sensors.position.push_back(at + kLift * normal);
      sensors.normal.push_back(normal);
    };
    add({t, 2.3, 12}, kZenith);      // roofs, over the common wall
    add({-10, t, 6.1}, {-1, 0, 0});  // outer walls
    add({t, 10, 3.3}, {0, 1, 0});
    add({30 + t, t, 0}, kZenith);  // ground
  }
  for (const TestScene* scene : {&one, &two}) {
    const ShadowMaps maps(scene->soup, scene->materials, software(512));
    testing_support::expect_engines_alike("walls that coincide", rays, maps, sensors, 60);
  }
}

TEST(ShadowStability, GeometryFarFromTheOriginIsShadedAsAtTheOrigin) {
  const Vec3 far{500'000.0, -310'000.0, 1200.0};
  TestScene near;
  near.level({-60, -60, 60, 60}, 0.0);
  near.box({-8, -6, 0}, {16, 12, 20}, 25.0);
  TestScene moved = near;
  for (Vec3& v : moved.soup.vertices) v = v + far;
  Sensors here = level_grid(55, 50, kLift);
  Sensors there = here;
  for (Vec3& p : there.position) p = p + far;
  const ShadowMaps maps_here(near.soup, near.materials, software(512));
  const ShadowMaps maps_there(moved.soup, moved.materials, software(512));
  std::size_t different = 0, all = 0;
  for (const Vec3 toward : testing_support::even_directions(40)) {
    const auto a = seen_from(maps_here, toward, here), b = seen_from(maps_there, toward, there);
    for (std::size_t s = 0; s < a.size(); ++s) {
      ++all;
      different += std::abs(a[s] - b[s]) > 0.01F;
      EXPECT_LE(std::abs(a[s] - b[s]), 0.75F) << "not more than an outline's texel";
    }
  }
  // Positions in float move an outline by 0.25 mm, a four-hundredth of a texel: of the pairs a few
  // in a hundred thousand change a texel.
  EXPECT_LE(static_cast<double>(different), 1e-3 * static_cast<double>(all));
}

TEST(ShadowStability, OneTriangleOfTenKilometresIsDrawnInPlace) {
  TestScene scene;
  scene.level({-10, -10, 10, 10}, 0.0);
  // A screen 40 m above the ground whose edge runs over the origin, from 5 km south to 5 km north.
  scene.quad({0, -5000, 40}, {0, 5000, 40}, {9000, 5000, 40}, {9000, 5000, 40});
  const RayVisibility rays(scene.soup, scene.materials);
  const ShadowMaps maps(scene.soup, scene.materials, software(256));
  Sensors sensors = level_grid(9, 40, kLift);
  testing_support::expect_engines_alike("a triangle of ten kilometres", rays, maps, sensors, 60);
}

// Beside its outline a fine mesh is known by triangles next to those that the texels show.
TEST(ShadowStability, AFinelyMeshedRoofIsSharpAtItsEdges) {
  TestScene scene;
  scene.level({-30, -30, 30, 30}, 0.0);
  scene.begin_object();
  const auto at = [](double x, double y) {
    return Vec3{x, y, 8.0 + 0.3 * std::sin(0.7 * x) * std::cos(0.6 * y)};
  };
  for (double x = -10; x < 10; x += 0.5) {
    for (double y = -10; y < 10; y += 0.5) {
      scene.quad(at(x, y), at(x + 0.5, y), at(x + 0.5, y + 0.5), at(x, y + 0.5));
    }
  }
  const RayVisibility rays(scene.soup, scene.materials);
  const ShadowMaps maps(scene.soup, scene.materials, software(200));
  const Sensors sensors = level_grid(29, 100, kLift);
  const auto found =
      testing_support::expect_engines_alike("a finely meshed roof", rays, maps, sensors, 60);
  EXPECT_LE(found.pair_mean, 1e-4);
}

TEST(ShadowStability, ACityWithoutHeightIsOpen) {
  TestScene scene;
  scene.level({-50, -50, 50, 50}, 0.0);
  scene.box({-10, -10, 0}, {20, 20, 0});
  const ShadowMaps maps(scene.soup, scene.materials, software(128));
  const Sensors sensors = level_grid(40, 30, kLift);
  for (const Vec3 toward : testing_support::even_directions(30)) {
    for (const float one : seen_from(maps, toward, sensors)) EXPECT_EQ(one, 1.0F);
  }
}

TEST(ShadowStability, PointsInsideAClosedBoxSeeNothing) {
  TestScene scene;
  scene.box({-20, -20, 0}, {40, 40, 10});
  const ShadowMaps maps(scene.soup, scene.materials, software(128));
  const Sensors sensors = level_grid(15, 20, 1.0);
  for (const Vec3 toward : testing_support::even_directions(30)) {
    if (toward.z < 0.5) continue;  // lower, walls stand within two texels of the rays' outline
    for (const float one : seen_from(maps, toward, sensors)) EXPECT_EQ(one, 0.0F);
  }
}

}  // namespace
}  // namespace tenku
