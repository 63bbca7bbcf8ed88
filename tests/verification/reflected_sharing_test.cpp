// Reflected light shared between sensors against that of sensors calculated on their own.
#include <gtest/gtest.h>

#include "support/measured.h"
#include "support/test_scene.h"

namespace tenku {
namespace {

using testing_support::Coverage;
using testing_support::TestScene;

constexpr double kOpenLux = 10000.0;

/// A house whose south wall, in the plane y = 0, lies half behind the next house, on open ground.
TestScene terrace() {
  TestScene scene;
  scene.materials[0] = testing_support::grey_material(0.4);
  scene.level({-400, -400, 400, 400}, 0.0);
  scene.box({0, 0, 0}, {20, 10, 12});
  scene.box({0, -10, 0}, {10, 10, 8});
  return scene;
}

/// Over the south wall, from its hidden corner on.
Sensors on_south_wall() {
  Sensors sensors;
  for (double x = 0.25; x < 20.0; x += 0.5) {
    for (double z = 0.25; z < 12.0; z += 0.5) {
      sensors.position.push_back({x, 0.0, z});
      sensors.normal.push_back({0, -1, 0});
    }
  }
  return sensors;
}

bool is_hidden(Vec3 p) { return p.x < 10.0 && p.z < 8.0; }

DaylightSource sun_and_sky() {
  auto source = testing_support::source_of(*testing_support::numbered_sky(12, 50, 150));
  source.sun.direction = direction_from(Angle::degrees(150), Angle::degrees(50));
  source.sun.normal_illuminance = Illuminance(5.0 * kOpenLux);
  return source;
}

IlluminanceOptions sharing(double distance_m, double tolerance_pct) {
  auto options = testing_support::direct_options(tolerance_pct);
  options.bounces = 2;
  options.share_reflected_m = distance_m;
  return options;
}

TEST(ReflectedSharing, TakesNothingFromSensorsInAPartyWall) {
  const Sensors sensors = on_south_wall();
  const auto source = sun_and_sky();
  const auto result = illuminate(terrace(), sensors, source, sharing(24.0, 5.0));
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const Vec3 p = sensors.position[i];
    const std::string where = std::to_string(p.x) + " " + std::to_string(p.z);
    if (is_hidden(p)) {
      EXPECT_EQ(result.values.reflected_lux[i], 0.0) << where;
    } else {
      // The lit ground alone fills half of what such a wall sees; the house next door takes a part.
      EXPECT_GT(result.values.reflected_lux[i], 0.02 * source.unobstructed_lux()) << where;
    }
  }
}

TEST(ReflectedSharing, IntervalsHoldWhatSensorsGetOnTheirOwn) {
  const Sensors sensors = on_south_wall();
  const auto source = sun_and_sky();
  const auto own = illuminate(terrace(), sensors, source, sharing(0.0, 1.0));
  for (const double distance_m : {6.0, 24.0}) {
    const auto shared = illuminate(terrace(), sensors, source, sharing(distance_m, 5.0));
    Coverage coverage;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      if (is_hidden(sensors.position[i])) continue;
      coverage.add(shared.values.total_lux(i), own.values.total_lux(i), shared.values.error_lux[i]);
    }
    std::printf("[ MEASURED ] inside, sharing over %.0f m: %.1f %% of %zu\n", distance_m,
                coverage.pct(), coverage.count());
    EXPECT_GE(coverage.pct(), 91.0) << distance_m;  // 95 less the scatter of 300 pilots and cells
  }
}

void expect_count_of_wide_intervals(const IlluminanceResult& result, double floor_lux,
                                    double tolerance_pct) {
  std::size_t wide = 0;
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const double allowed = 0.01 * tolerance_pct * std::max(result.values.total_lux(i), floor_lux);
    wide += result.values.error_lux[i] > allowed;
  }
  EXPECT_GT(wide, 0u);
  EXPECT_GE(result.out_of_tolerance, wide);
  EXPECT_LE(result.out_of_tolerance, wide + wide / 10);  // and who met the limit of effort
}

TEST(OutOfTolerance, CountsWhatSharingCosts) {
  const auto source = sun_and_sky();
  const auto result = illuminate(terrace(), on_south_wall(), source, sharing(24.0, 1.0));
  expect_count_of_wide_intervals(result, 0.001 * source.unobstructed_lux(), 1.0);
}

// After two bounces between walls of reflectance 0.8 a good half of the light is still to come.
TEST(OutOfTolerance, CountsBouncesLeftOut) {
  TestScene scene;
  scene.materials[0] = testing_support::grey_material(0.8);
  scene.materials[0].emission_lm_m2 = Rgb::grey(1000.0);
  scene.box({0, 0, 0}, {4, 5, 3});
  Sensors sensors;
  sensors.position = {{1, 2, 1}, {2, 2.5, 0}};
  sensors.normal = {kZenith, kZenith};
  auto options = testing_support::direct_options(5.0);
  options.bounces = 2;
  EXPECT_EQ(illuminate(scene, sensors, {}, options).out_of_tolerance, 2u);
  options.bounces = 40;  // 0.8^40 = 1.3e-4 is left
  EXPECT_EQ(illuminate(scene, sensors, {}, options).out_of_tolerance, 0u);
}

}  // namespace
}  // namespace tenku
