// A town of random cuboids: intervals against its own converged values, and the same bits again.
#include <gtest/gtest.h>

#include <cstdio>

#include "core/parallel.h"
#include "core/random.h"
#include "support/test_scene.h"

namespace tenku {
namespace {

using testing_support::Coverage;
using testing_support::TestScene;

struct Town {
  TestScene scene;
  Sensors sensors;
};

/// Cuboids on a square of ground, sensors on the ground (half) and on walls.
Town random_town(int boxes, double side_m, int sensors) {
  Town town;
  SampleRandom random(4711, 0, 0);
  std::vector<std::array<double, 4>> plan;
  town.scene.level({0, 0, side_m, side_m}, 0.0);
  for (int i = 0; i < boxes; ++i) {
    const Vec3 corner{side_m * random.uniform(), side_m * random.uniform(), 0.0};
    const Vec3 size{6.0 + 14.0 * random.uniform(), 6.0 + 14.0 * random.uniform(),
                    3.0 + 40.0 * random.uniform() * random.uniform()};
    town.scene.box(corner, size);
    plan.push_back({corner.x, corner.y, corner.x + size.x, corner.y + size.y});
    if (i >= sensors / 2) continue;
    town.sensors.position.push_back(
        {corner.x, corner.y + size.y * random.uniform(), size.z * random.uniform()});
    town.sensors.normal.push_back({-1.0, 0.0, 0.0});
  }
  while (town.sensors.size() < static_cast<std::size_t>(sensors)) {
    const Vec3 p{side_m * random.uniform(), side_m * random.uniform(), 0.0};
    const bool indoors = std::any_of(plan.begin(), plan.end(), [&](const auto& b) {
      return p.x > b[0] && p.y > b[1] && p.x < b[2] && p.y < b[3];
    });
    if (indoors) continue;
    town.sensors.position.push_back(p);
    town.sensors.normal.push_back(kZenith);
  }
  return town;
}

TEST(Interval, HoldsTheConvergedValuesOfATown) {
  const Town town = random_town(3000, 1000.0, 400);
  for (const int sky : {16, 12}) {
    const auto source = testing_support::source_of(*testing_support::numbered_sky(sky, 40, 180));
    auto exact = testing_support::direct_options(0.1, 99);
    exact.most_slices = 1 << 15;
    const auto truth = illuminate(town.scene, town.sensors, source, exact);
    for (const double tolerance : {5.0, 2.0, 1.0, 0.5}) {
      Coverage coverage;
      double rays = 0.0;
      for (std::uint64_t seed = 21; seed < 24; ++seed) {
        const auto result = illuminate(town.scene, town.sensors, source,
                                       testing_support::direct_options(tolerance, seed));
        rays += static_cast<double>(result.rays) / 3.0 / static_cast<double>(town.sensors.size());
        for (std::size_t i = 0; i < town.sensors.size(); ++i) {
          coverage.add(result.values.total_lux(i), truth.values.total_lux(i),
                       result.values.error_lux[i]);
        }
      }
      std::printf(
          "[ MEASURED ] interval, town, sky %d, tolerance %g: holds %.1f %% of %zu "
          "(%.0f rays a sensor)\n",
          sky, tolerance, coverage.pct(), coverage.count(), rays);
      EXPECT_GE(coverage.pct(), 93.0);
      EXPECT_LE(coverage.pct(), 99.0);
    }
  }
}

TEST(Illuminate, GivesTheSameBitsForAnyNumberOfThreadsAndAgain) {
  Town town = random_town(60, 150.0, 40);
  town.scene.materials[0] = testing_support::grey_material(0.4);
  auto source = testing_support::source_of(*testing_support::numbered_sky(12, 40, 180));
  source.sun.direction = direction_from(Angle::degrees(180), Angle::degrees(40));
  source.sun.normal_illuminance = Illuminance(80000.0);
  auto options = testing_support::direct_options(10.0);
  options.bounces = 2;
  const auto run = [&](unsigned threads) {
    const ThreadLimit limit(threads);
    return illuminate(town.scene, town.sensors, source, options);
  };
  const auto one = run(1), two = run(2), again = run(2);
  for (const auto* other : {&two, &again}) {
    EXPECT_EQ(one.values.sun_lux, other->values.sun_lux);
    EXPECT_EQ(one.values.sky_lux, other->values.sky_lux);
    EXPECT_EQ(one.values.reflected_lux, other->values.reflected_lux);
    EXPECT_EQ(one.values.error_lux, other->values.error_lux);
    EXPECT_EQ(one.values.sky_view, other->values.sky_view);
  }
}

}  // namespace
}  // namespace tenku
