// The shadow-map engine against the ray engine, and against closed forms.
#include "visibility/shadow_maps.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "support/engine_comparison.h"

namespace tenku {
namespace {

using testing_support::even_directions;
using testing_support::TestScene;

constexpr double kLift = 1e-5;  // m, as the ray engine lifts sensors near the origin

ShadowMapOptions software(int texels) {
  ShadowMapOptions options;
  options.texels = texels;
  options.platform = GlPlatform::OsMesa;
  return options;
}

void add_sensor(Sensors& sensors, Vec3 at, Vec3 normal) {
  sensors.position.push_back(at + kLift * normal);
  sensors.normal.push_back(normal);
}

/// Sensors at random on all faces of the scene, as many on each unit of area.
Sensors on_surfaces(const TestScene& scene, double lift_m, std::size_t count) {
  std::vector<double> area{0.0};
  const auto corner = [&](std::size_t t, std::size_t k) {
    return scene.soup.vertices[scene.soup.triangles[t][k]];
  };
  for (std::size_t t = 0; t < scene.soup.size(); ++t) {
    area.push_back(area.back() +
                   0.5 * length(cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0))));
  }
  Sensors sensors;
  SampleRandom random(7, 0, 0);
  while (sensors.size() < count) {
    const double at = area.back() * random.uniform();
    const auto t =
        static_cast<std::size_t>(std::upper_bound(area.begin(), area.end(), at) - area.begin() - 1);
    const double u = std::sqrt(random.uniform()), v = random.uniform();
    const Vec3 a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
    const Vec3 normal = normalized(cross(b - a, c - a));
    if (normal.z < -0.5) continue;  // undersides
    sensors.position.push_back(a + u * (1 - v) * (b - a) + u * v * (c - a) + lift_m * normal);
    sensors.normal.push_back(normal);
  }
  return sensors;
}

void expect_alike(const TestScene& scene, const std::string& name, std::size_t sensors,
                  int texels) {
  const RayVisibility rays(scene.soup, scene.materials);
  const ShadowMaps maps(scene.soup, scene.materials, software(texels));
  testing_support::expect_engines_alike(name + ", " + std::to_string(texels) + " texels", rays,
                                        maps, on_surfaces(scene, rays.lift_m(), sensors), 145);
}

TEST(ShadowMaps, ABoxOnAPlaneIsLitAsByRays) {
  TestScene scene;
  scene.level({-30, -30, 30, 30}, 0.0);
  scene.box({-5, -4, 0}, {10, 8, 12}, 20.0);
  expect_alike(scene, "box on a plane", 3000, 512);
}

TEST(ShadowMaps, ACourtyardIsLitAsByRays) {
  TestScene scene;
  scene.level({-40, -40, 40, 40}, 0.0);
  scene.box({-20, -20, 0}, {40, 8, 15});
  scene.box({-20, 12, 0}, {40, 8, 15});
  scene.box({-20, -12, 0}, {8, 24, 15});
  scene.box({12, -12, 0}, {8, 24, 15});
  expect_alike(scene, "courtyard", 3000, 512);
}

TEST(ShadowMaps, AStreetCanyonIsLitAsByRays) {
  TestScene scene;
  scene.level({-100, -20, 100, 20}, 0.0);
  scene.box({-100, -20, 0}, {200, 12, 18});
  scene.box({-100, 8, 0}, {200, 12, 24});
  expect_alike(scene, "street canyon", 3000, 512);
}

TestScene random_town() {
  TestScene scene;
  scene.level({-500, -500, 500, 500}, 0.0);
  SampleRandom random(1, 2, 3);
  for (int b = 0; b < 3000; ++b) {
    const double x = 980.0 * random.uniform() - 490.0, y = 980.0 * random.uniform() - 490.0;
    const double w = 5.0 + 10.0 * random.uniform(), d = 5.0 + 10.0 * random.uniform();
    const double h = 3.0 + 27.0 * random.uniform();
    scene.box({x, y, 0.0}, {w, d, h}, 90.0 * random.uniform());
  }
  return scene;
}

TEST(ShadowMaps, ATownOf3000BoxesIsLitAsByRays) {
  expect_alike(random_town(), "town of 3000 boxes", 4000, 1024);
}

// Elevation h/d of the top of an endless wall at distance d: directions below it are hidden, those
// above open; in between nothing.
TEST(ShadowMaps, AWallHidesExactlyTheDirectionsBelowItsTop) {
  TestScene scene;
  scene.level({-100, -100, 100, 100}, 0.0);
  scene.wall({-2000, 10, 2000, 10}, 0, 8);
  const ShadowMaps maps(scene.soup, scene.materials, software(256));
  std::vector<Vec3> points, normals;
  for (int k = -50; k <= 50; ++k) {
    points.push_back({0.3 * k, 0.0, kLift});
    normals.push_back(kZenith);
  }
  const double top = std::atan2(8.0, 10.0);
  for (const double away : {-0.5, -0.05, -0.005, 0.005, 0.05, 0.5}) {
    const Vec3 toward = direction_from(Angle::degrees(0), Angle::radians(top + away));
    std::vector<float> seen(points.size());
    maps.transmission_from(toward, points, normals, seen);
    for (const float one : seen) EXPECT_EQ(one, away < 0.0 ? 0.0F : 1.0F) << away;
  }
}

TEST(ShadowMaps, ShadowsFromFarOutsideTheRegionReachIt) {
  TestScene scene;
  scene.level({-10, -10, 10, 10}, 0.0);
  scene.wall({-5000, 3000, 5000, 3000}, 0, 600);
  const ShadowMaps maps(scene.soup, scene.materials, software(64));
  const std::vector<Vec3> points{{0, 0, kLift}, {1, 1, kLift}};
  const std::vector<Vec3> normals(2, kZenith);
  std::vector<float> seen(2);
  maps.transmission_from(direction_from(Angle::degrees(0), Angle::degrees(11)), points, normals,
                         seen);
  EXPECT_EQ(seen, (std::vector<float>{0, 0}));  // atan(600 / 3000) = 11.3 degrees
  maps.transmission_from(direction_from(Angle::degrees(0), Angle::degrees(12)), points, normals,
                         seen);
  EXPECT_EQ(seen, (std::vector<float>{1, 1}));
}

TEST(ShadowMaps, GlassLetsThroughWhatTheRayEngineLetsThrough) {
  TestScene scene;
  Material glass;
  glass.name = "glass";
  glass.transmittance = 0.8;
  scene.materials.push_back(glass);
  scene.level({-10, -10, 10, 10}, 0.0);
  scene.level({-10, -10, 0, 10}, 3.0, 1);
  scene.level({-10, -10, 10, -5}, 4.0);
  const RayVisibility rays(scene.soup, scene.materials);
  const ShadowMaps maps(scene.soup, scene.materials, software(256));
  Sensors sensors;
  for (const double x : {-6.0, -4.0, 4.0, 6.0}) {
    for (const double y : {-8.0, 2.0}) add_sensor(sensors, {x, y, 0}, kZenith);
  }
  for (const Vec3 toward : {kZenith, normalized(Vec3{0.2, 0.1, 1.0})}) {
    std::vector<float> by_rays(sensors.size()), by_maps(sensors.size());
    rays.transmission_from(toward, sensors.position, sensors.normal, by_rays);
    maps.transmission_from(toward, sensors.position, sensors.normal, by_maps);
    for (std::size_t s = 0; s < sensors.size(); ++s) EXPECT_NEAR(by_maps[s], by_rays[s], 1e-6);
  }
  std::vector<float> seen(sensors.size());
  maps.transmission_from(kZenith, sensors.position, sensors.normal, seen);
  EXPECT_NEAR(seen[1], 0.8, 1e-6) << "one pane at normal incidence";
}

TEST(ShadowMaps, PairsInAnyOrderAreGroupedByDirection) {
  TestScene scene;
  scene.level({-20, -20, 20, 20}, 0.0);
  scene.box({-3, -3, 0}, {6, 6, 6});
  const RayVisibility rays(scene.soup, scene.materials);
  const ShadowMaps maps(scene.soup, scene.materials, software(256));
  const std::vector<Vec3> two{normalized(Vec3{1, 0.2, 1}), normalized(Vec3{-1, 0.1, 1})};
  std::vector<Vec3> origin, direction;
  for (int k = 0; k < 20; ++k) {
    origin.push_back({k - 9.7, 0.4, k > 6 && k < 13 ? 6.0 + kLift : kLift});
    direction.push_back(two[static_cast<std::size_t>(k % 2)]);
  }
  std::vector<float> by_rays(origin.size()), by_maps(origin.size());
  rays.transmission(origin, direction, by_rays);
  maps.transmission(origin, direction, by_maps);
  EXPECT_EQ(by_maps, by_rays);
  EXPECT_EQ(maps.maps_drawn(), 2u);
}

TEST(ShadowMaps, ResultsDoNotDependOnTheThreads) {
  const TestScene scene = random_town();
  const Sensors sensors = on_surfaces(scene, kLift, 2000);
  const auto directions = even_directions(12);
  const auto run = [&](unsigned threads) {
    const ThreadLimit limit(threads);
    const ShadowMaps maps(scene.soup, scene.materials, software(512));
    std::vector<std::vector<float>> seen(directions.size(), std::vector<float>(sensors.size()));
    parallel_for(directions.size(), 1, [&](IndexRange range) {
      for (std::size_t d = range.begin; d < range.end; ++d) {
        maps.transmission_from(directions[d], sensors.position, sensors.normal, seen[d]);
      }
    });
    return seen;
  };
  const auto one = run(1);
  EXPECT_EQ(run(2), one);
  EXPECT_EQ(run(4), one);
}

TEST(ShadowMaps, MapsOfNoTexelsAreRefused) {
  TestScene scene;
  scene.level({-1, -1, 1, 1}, 0.0);
  EXPECT_THROW(ShadowMaps(scene.soup, scene.materials, software(0)), InputError);
  EXPECT_THROW(ShadowMaps(scene.soup, scene.materials, software(100000)), InputError);
}

}  // namespace
}  // namespace tenku
