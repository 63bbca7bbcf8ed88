// A town of random cuboids: intervals against its own converged values, and the same bits again.
#include <gtest/gtest.h>

#include <cstdio>

#include "core/parallel.h"
#include "support/random_town.h"

namespace tenku {
namespace {

using testing_support::Coverage;
using testing_support::random_town;
using testing_support::Town;

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
