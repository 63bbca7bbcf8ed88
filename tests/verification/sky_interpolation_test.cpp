// Skylight taken from the sensors around, against rays ten times as exact.
#include "illuminance/sky_interpolation.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "core/parallel.h"
#include "support/random_town.h"

namespace tenku {
namespace {

using testing_support::Coverage;
using testing_support::direct_options;
using testing_support::numbered_sky;
using testing_support::random_town;
using testing_support::Town;

/// A square of `side_m` with sensors every so many metres, houses on it or not.
struct Square {
  Town town;
  RayVisibility rays;
  std::unique_ptr<SkyModel> sky = numbered_sky(12, 40.0, 150.0);
  DaylightSource source;

  Square(int houses, double side_m, double spacing_m)
      : town(grid_on(random_town(houses, side_m, 0), side_m, spacing_m)),
        rays(town.scene.soup, town.scene.materials) {
    source.sky = std::make_unique<SkyTable>(*sky);
    source.model = sky.get();
    source.sun.direction = direction_from(Angle::degrees(150.0), Angle::degrees(40.0));
    source.sun.angular_radius = Angle::degrees(0.2665);
    source.sun.normal_illuminance = Illuminance(60000.0);
  }

  static Town grid_on(Town town, double side_m, double spacing_m) {
    for (double x = 0.5 * spacing_m; x < side_m; x += spacing_m) {
      for (double y = 0.5 * spacing_m; y < side_m; y += spacing_m) {
        town.sensors.position.push_back({x, y, 0.0});
        town.sensors.normal.push_back(kZenith);
      }
    }
    return town;
  }
};

TEST(SkyInterpolation, IntervalsHoldWhatRaysFind) {
  const Square square(40, 120.0, 0.6);
  Progress quiet;
  for (const double tolerance : {5.0, 2.0}) {
    std::size_t interpolated = 0;
    const auto sparse = illuminate_sparsely(square.town.sensors, square.rays, square.source,
                                            direct_options(tolerance), quiet, &interpolated);
    std::vector<std::uint32_t> some;
    for (std::uint32_t s = 0; s < square.town.sensors.size(); s += 23) some.push_back(s);
    const auto truth = illuminate(sensors_of(square.town.sensors, some), square.rays, square.source,
                                  direct_options(0.1 * tolerance, 99), quiet);
    Coverage coverage;
    double worst = 0.0;
    for (std::size_t k = 0; k < some.size(); ++k) {
      const double found = sparse.values.total_lux(some[k]), is = truth.values.total_lux(k);
      coverage.add(found, is, sparse.values.error_lux[some[k]] + truth.values.error_lux[k]);
      if (is > 100.0) worst = std::max(worst, std::abs(found - is) / is);
    }
    const double share =
        100.0 * static_cast<double>(interpolated) / static_cast<double>(square.town.sensors.size());
    std::printf(
        "[ MEASURED ] interval of skylight from those around, tolerance %g: %.0f %% of %zu sensors "
        "interpolated; holds %.1f %% of %zu; worst %.1f %%\n",
        tolerance, share, square.town.sensors.size(), coverage.pct(), coverage.count(),
        100.0 * worst);
    EXPECT_GT(share, 30.0);
    EXPECT_GE(coverage.pct(), 93.0);
  }
}

// On an open field every plane is exact: only what the rounds need is calculated.
TEST(SkyInterpolation, AnOpenFieldIsTheOpenSky) {
  const Square field(0, 60.0, 0.5);
  Progress quiet;
  std::size_t interpolated = 0;
  const auto sparse = illuminate_sparsely(field.town.sensors, field.rays, field.source,
                                          direct_options(2.0), quiet, &interpolated);
  EXPECT_GT(interpolated, field.town.sensors.size() * 9 / 10);
  for (std::size_t s = 0; s < field.town.sensors.size(); ++s) {
    EXPECT_NEAR(sparse.values.sky_view[s], 1.0, 1e-6);
    EXPECT_NEAR(sparse.values.sun_lux[s], 60000.0 * std::sin(40.0 * kPi / 180.0), 20.0);
  }
}

// A house of four walls and a roof amid the field: nothing shines in, whatever those outside see.
TEST(SkyInterpolation, TheLightOfTheStreetDoesNotComeIn) {
  Square square(0, 40.0, 0.5);
  square.town.scene.box({15.0, 15.0, 0.0}, {10.0, 10.0, 5.0});
  const RayVisibility rays(square.town.scene.soup, square.town.scene.materials);
  Progress quiet;
  const auto sparse =
      illuminate_sparsely(square.town.sensors, rays, square.source, direct_options(5.0), quiet);
  for (std::size_t s = 0; s < square.town.sensors.size(); ++s) {
    const Vec3 p = square.town.sensors.position[s];
    const bool inside = p.x > 15.0 && p.x < 25.0 && p.y > 15.0 && p.y < 25.0;
    EXPECT_EQ(sparse.values.sky_lux[s] > 0.0, !inside) << p.x << " " << p.y;
  }
}

TEST(SkyInterpolation, GivesTheSameBitsForAnyNumberOfThreads) {
  const Square square(10, 60.0, 0.8);
  Progress quiet;
  const auto run = [&](unsigned threads) {
    const ThreadLimit limit(threads);
    return illuminate_sparsely(square.town.sensors, square.rays, square.source, direct_options(5.0),
                               quiet);
  };
  const auto one = run(1), two = run(2);
  for (std::size_t s = 0; s < square.town.sensors.size(); ++s) {
    EXPECT_EQ(one.values.total_lux(s), two.values.total_lux(s));
    EXPECT_EQ(one.values.error_lux[s], two.values.error_lux[s]);
  }
}

}  // namespace
}  // namespace tenku
