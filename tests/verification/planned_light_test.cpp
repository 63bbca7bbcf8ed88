// Light as a plan finds it: intervals from pilots, the paper's level of detail, either engine.
#include "illuminance/planned_light.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "core/error.h"
#include "core/parallel.h"
#include "illuminance/paper_detail.h"
#include "support/random_town.h"

namespace tenku {
namespace {

using testing_support::Coverage;
using testing_support::direct_options;
using testing_support::numbered_sky;
using testing_support::random_town;
using testing_support::Town;

/// A sky and what is needed of it, kept together.
struct Daylight {
  std::unique_ptr<SkyModel> sky;
  DaylightSource source;

  Daylight(int type, double sun_lux) : sky(numbered_sky(type, 40.0, 150.0)) {
    source.sky = std::make_unique<SkyTable>(*sky);
    source.model = sky.get();
    source.sun.direction = direction_from(Angle::degrees(150.0), Angle::degrees(40.0));
    source.sun.angular_radius = Angle::degrees(0.2665);
    source.sun.normal_illuminance = Illuminance(sun_lux);
  }
};

LightMethod by(EngineChoice engine, Detail detail = Detail::Budget) {
  LightMethod method;
  method.engine = engine;
  method.detail = detail;
  return method;
}

// A town of 800 boxes, 1,500 sensors by shadow maps; the truth by rays, twenty times as exact.
TEST(PlannedLight, IntervalsOfShadowMapsHoldWhatRaysFind) {
  const Town town = random_town(800, 500.0, 1500);
  const Engines engines(town.scene.soup, town.scene.materials, GlPlatform::OsMesa);
  Progress quiet;
  for (const double sun : {0.0, 60000.0}) {
    const Daylight light(12, sun);
    const auto truth =
        illuminate(town.sensors, engines.rays(), light.source, direct_options(0.5, 99), quiet);
    for (const double tolerance : {30.0, 15.0}) {
      const auto result = illuminate(town.sensors, engines, light.source, direct_options(tolerance),
                                     by(EngineChoice::ShadowMaps), quiet);
      Coverage coverage;
      double error = 0.0;
      for (std::size_t i = 0; i < town.sensors.size(); ++i) {
        coverage.add(result.values.total_lux(i), truth.values.total_lux(i),
                     result.values.error_lux[i]);
        error += result.values.error_lux[i] / static_cast<double>(town.sensors.size());
      }
      const PlannedRegion& region = result.regions.front();
      std::printf(
          "[ MEASURED ] interval by pilots, town, shadow maps, sun %.0f lx, tolerance %g: holds "
          "%.1f %% of %zu; mean %.0f lx; %zu elements, texels of %.2f m, casters to %.0f m\n",
          sun, tolerance, coverage.pct(), coverage.count(), error, region.elements, region.texel_m,
          region.reach_m);
      EXPECT_EQ(region.engine, Engine::ShadowMaps);
      EXPECT_GT(region.elements, 20U);
      // 200 pilots settle the share to 1.6 % (a beta distribution); three of these allowed.
      EXPECT_GE(coverage.pct(), 90.0);
      EXPECT_LE(coverage.pct(), 99.5);
    }
  }
}

TEST(PlannedLight, ShadowMapsGiveTheSameBitsForAnyNumberOfThreads) {
  const Town town = random_town(100, 150.0, 200);
  const Engines engines(town.scene.soup, town.scene.materials, GlPlatform::OsMesa);
  const Daylight light(12, 60000.0);
  Progress quiet;
  const auto run = [&](unsigned threads) {
    const ThreadLimit limit(threads);
    return illuminate(town.sensors, engines, light.source, direct_options(30.0),
                      by(EngineChoice::ShadowMaps), quiet);
  };
  const auto one = run(1), two = run(2);
  for (std::size_t i = 0; i < town.sensors.size(); ++i) {
    EXPECT_EQ(one.values.total_lux(i), two.values.total_lux(i));
    EXPECT_EQ(one.values.error_lux[i], two.values.error_lux[i]);
  }
}

// All elements for all sensors is the same sum by either engine.
TEST(PlannedLight, WithoutLevelOfDetailTheEnginesAgree) {
  const Town town = random_town(200, 250.0, 300);
  const Engines engines(town.scene.soup, town.scene.materials, GlPlatform::OsMesa);
  Daylight light(12, 60000.0);
  PartitionRequest request;
  request.elements = 145;
  light.source.partition = request;
  light.source.elements =
      std::make_unique<ElementSky>(*light.sky, partition_sky(*light.sky, request));
  Progress quiet;
  const auto rays = illuminate(town.sensors, engines, light.source, direct_options(5.0),
                               by(EngineChoice::Rays, Detail::Off), quiet);
  const auto maps = illuminate(town.sensors, engines, light.source, direct_options(5.0),
                               by(EngineChoice::ShadowMaps, Detail::Off), quiet);
  ASSERT_EQ(maps.regions.front().elements, 145U);
  double mean = 0.0;
  for (std::size_t i = 0; i < town.sensors.size(); ++i) {
    mean += std::abs(rays.values.total_lux(i) - maps.values.total_lux(i)) /
            static_cast<double>(town.sensors.size());
  }
  std::printf("[ MEASURED ] no level of detail, engines differ by %.4f %% of the open light\n",
              100.0 * mean / light.source.unobstructed_lux());
  EXPECT_LE(mean, 0.005 * light.source.unobstructed_lux());
}

TEST(PlannedLight, FewSensorsAreLitByRaysWithoutAPlan) {
  const Town town = random_town(20, 100.0, 40);
  const Engines engines(town.scene.soup, town.scene.materials, GlPlatform::OsMesa);
  const Daylight light(16, 0.0);
  Progress quiet;
  const auto plain =
      illuminate(town.sensors, engines.rays(), light.source, direct_options(2.0), quiet);
  const auto planned = illuminate(town.sensors, engines, light.source, direct_options(2.0),
                                  by(EngineChoice::Auto), quiet);
  EXPECT_EQ(planned.regions.front().engine, Engine::Rays);
  EXPECT_EQ(engines.maps_drawn(), 0U);
  for (std::size_t i = 0; i < town.sensors.size(); ++i) {
    EXPECT_EQ(plain.values.total_lux(i), planned.values.total_lux(i));
  }
}

TEST(PlannedLight, ThePapersDetailNeedsAPicture) {
  const Town town = random_town(20, 100.0, 40);
  const Engines engines(town.scene.soup, town.scene.materials, GlPlatform::OsMesa);
  const Daylight light(16, 0.0);
  Progress quiet;
  EXPECT_THROW(illuminate(town.sensors, engines, light.source, direct_options(2.0),
                          by(EngineChoice::Rays, Detail::Paper), quiet),
               InputError);
}

// With ratios 1 to 19 and 20 pilots the rank is ceil(0.95 * 21) = 20: the greatest. With 199 it is
// ceil(0.95 * 200) = 190.
TEST(Pilots, IntervalIsTheRatioThatNineteenOfTwentyStayBelow) {
  for (const std::size_t count : {20U, 199U}) {
    Pilots pilots;
    std::vector<double> value, scale;
    for (std::size_t k = 1; k <= count; ++k) {
      const double ratio = static_cast<double>((11 * k) % (count + 1));  // 1 to count, in disorder
      pilots.lux.push_back(100.0);
      scale.push_back(2.0);
      value.push_back(100.0 + (k % 2 == 0 ? 2.0 : -2.0) * ratio);
    }
    EXPECT_DOUBLE_EQ(pilots.interval_per_scale(value, scale), count == 20 ? 20.0 : 190.0);
  }
}

/// Equal solid angles and a uniform sky: the light of an element goes by its height alone.
class PaperDetail : public testing::Test {
 protected:
  PaperDetail() {
    PartitionRequest request = parse_partition("uniform");
    request.elements = 64;
    sky_ = numbered_sky(5, 40.0, 180.0);
    elements_ = std::make_unique<SharedElements>(partition_sky(*sky_, request));
  }
  std::size_t needed(double mu, double pixels) const {
    SeenPolygons polygons;
    polygons.normal = {kZenith};
    polygons.pixels = {pixels};
    const auto wanted = paper_detail(*elements_, polygons, mu);
    const auto& all = wanted.elements.front();
    return static_cast<std::size_t>(std::count(all.begin(), all.end(), true));
  }

  std::unique_ptr<SkyModel> sky_;
  std::unique_ptr<SharedElements> elements_;
};

// Equation 4: the rest after j elements, brightest first; equation 5: times the pixels.
TEST_F(PaperDetail, TakesTheFirstElementsWhoseRestIsBelowTheThreshold) {
  std::vector<double> lux = elements_->unobstructed_parts(kZenith);
  std::sort(lux.rbegin(), lux.rend());
  double whole = 0.0;
  for (const double one : lux) whole += one;
  for (const double mu : {0.05, 0.5, 3.0}) {
    std::size_t j = 0;
    for (double rest = whole; rest / whole * 10.0 >= mu; rest -= lux[j++]) {
    }
    EXPECT_EQ(needed(mu, 10.0), j) << mu;
  }
}

TEST_F(PaperDetail, LargePolygonsNeedAllAndSmallOnesNone) {
  EXPECT_EQ(needed(1e-6, 1e6), 64U);
  EXPECT_EQ(needed(1.0, 0.9), 0U);
  EXPECT_EQ(needed(1.0, 0.0), 0U);
}

// What is not asked for counts as visible: a sensor under a roof is then as bright as in the open.
TEST_F(PaperDetail, ElementsThatAreNotNeededAreAmbient) {
  testing_support::TestScene scene;
  scene.level({-100, -100, 100, 100}, 3.0);
  const RayVisibility rays(scene.soup, scene.materials);
  Sensors sensors;
  sensors.position = {{0, 0, 0}, {0, 0, 0}};
  sensors.normal = {kZenith, kZenith};
  SeenPolygons polygons;
  polygons.of_sensor = {0, 1};
  polygons.normal = {kZenith, kZenith};
  polygons.pixels = {0.5, 1e9};
  const auto wanted = paper_detail(*elements_, polygons, 1.0);
  Progress quiet;
  const auto light = elements_->light(rays, sensors, quiet, &wanted);
  EXPECT_NEAR(light.lux[0] / elements_->unobstructed_lux(kZenith), 1.0, 1e-12);
  EXPECT_NEAR(light.sky_view[0], 1.0, 1e-12);
  EXPECT_LT(light.lux[1] / elements_->unobstructed_lux(kZenith), 0.01);
}

TEST_F(PaperDetail, RefusesThresholdsThatAreNoNumbersAboveZero) {
  EXPECT_THROW(needed(0.0, 1.0), InputError);
  EXPECT_THROW(needed(std::nan(""), 1.0), InputError);
  EXPECT_THROW(needed(HUGE_VAL, 1.0), InputError);
}

// Along a wall's shadow neighbouring sensors differ smoothly; elements make steps. 64 elements may
// make steps where 1024 make none, but none beyond what the interval says.
TEST(PlannedLight, BandsOfFewElementsLieInsideTheInterval) {
  testing_support::TestScene scene;
  scene.level({-60, -60, 60, 60}, 0.0);
  scene.wall({-60, 0, 60, 0}, 0.0, 10.0);
  const Engines engines(scene.soup, scene.materials, GlPlatform::OsMesa);
  Sensors sensors;
  for (int k = 0; k < 2000; ++k) {
    sensors.position.push_back({0.0, 0.05 + 0.015 * k, 0.0});
    sensors.normal.push_back(kZenith);
  }
  Progress quiet;
  Coverage coverage;
  double bands = 0.0;
  std::vector<double> fine;
  for (const std::size_t elements : {1024U, 64U}) {
    Daylight light(5, 0.0);
    PartitionRequest request = parse_partition("uniform");
    request.elements = elements;
    light.source.partition = request;
    light.source.elements =
        std::make_unique<ElementSky>(*light.sky, partition_sky(*light.sky, request));
    const auto result = illuminate(sensors, engines, light.source, direct_options(2.0),
                                   by(EngineChoice::ShadowMaps, Detail::Off), quiet);
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      const double lux = result.values.total_lux(i);
      if (elements == 1024U) {
        fine.push_back(lux);
        continue;
      }
      coverage.add(lux, fine[i], result.values.error_lux[i]);
      bands = std::max(bands, std::abs(lux - fine[i]) / light.source.unobstructed_lux());
    }
  }
  std::printf(
      "[ MEASURED ] bands of 64 elements against 1024: %.2f %% of the open sky at most; "
      "%.1f %% inside the interval\n",
      100.0 * bands, coverage.pct());
  EXPECT_GE(coverage.pct(), 93.0);
}

}  // namespace
}  // namespace tenku
