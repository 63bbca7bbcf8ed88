// Skylight and sunlight from shared directions, by either engine.
#include "illuminance/shared_elements.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "support/measured.h"
#include "verification/reference_cases.h"
#include "visibility/ray_visibility.h"
#include "visibility/shadow_maps.h"

namespace tenku {
namespace {

using testing_support::ReferenceTable;
using testing_support::TestScene;
using testing_support::WorstError;

SkyPartition divided(const SkyModel& sky, const std::string& method, std::size_t elements = 0) {
  PartitionRequest request = parse_partition(method);
  if (elements > 0) request.elements = elements;
  return partition_sky(sky, request);
}

ShadowMapOptions software(int texels) {
  ShadowMapOptions options;
  options.texels = texels;
  options.platform = GlPlatform::OsMesa;
  return options;
}

TestScene pavement() {
  TestScene scene;
  scene.level({-50, -50, 50, 50}, 0.0);
  return scene;
}

TEST(SharedElements, OpenHorizontalSensorReceivesTheWholeSkyFromBothEngines) {
  const TestScene scene = pavement();
  const RayVisibility rays(scene.soup, scene.materials);
  const ShadowMaps maps(scene.soup, scene.materials, software(64));
  Sensors sensors;
  sensors.position = {{0, 0, rays.lift_m()}, {20, -30, rays.lift_m()}};
  sensors.normal = {kZenith, kZenith};
  const ReferenceTable table(TENKU_TEST_REFERENCE "/sky/cie_integrals.csv");
  WorstError worst("open horizontal sensor, shared directions, relative to the integral");
  for (std::size_t row = 0; row < table.size(); ++row) {
    const double altitude = table.number(row, "sun_alt_deg");
    if (table.text(row, "quantity") != "Ehd_over_Lz_sr" || altitude != 50.0) continue;
    const int type = static_cast<int>(table.number(row, "sky_type"));
    const auto sky = testing_support::numbered_sky(type, altitude, 180.0);
    const SharedElements elements(divided(*sky, "tregenza"));
    const double truth = 3000.0 * table.number(row, "value");
    Progress quiet;
    for (const Visibility* engine :
         {static_cast<const Visibility*>(&rays), static_cast<const Visibility*>(&maps)}) {
      const auto light = elements.light(*engine, sensors, quiet);
      for (const double lux : light.lux) worst.add(lux / truth - 1.0, std::to_string(type));
      for (const double view : light.sky_view) EXPECT_NEAR(view, 1.0, 1e-12);
    }
  }
  EXPECT_LE(worst.worst(), 1e-6);
}

// A uniform sky gives a tilted plane pi L (1 + cos tilt) / 2, also where the plane cuts elements.
TEST(SharedElements, TiltedSensorsReceiveTheClosedForm) {
  TestScene scene;  // far below, so that nothing hides the sky
  scene.level({-1, -1, 1, 1}, -100.0);
  const RayVisibility rays(scene.soup, scene.materials);
  const auto sky = testing_support::numbered_sky(5, 40.0, 180.0);
  WorstError worst("open tilted sensors under a uniform sky in shared directions, relative");
  Sensors sensors;
  std::vector<double> share;
  for (const double tilt_deg : {30.0, 90.0, 135.0}) {
    for (const double turn : {0.0, 0.7, 2.0}) {
      const double tilt = tilt_deg * kPi / 180.0;
      sensors.position.push_back({0, 0, 1});
      sensors.normal.push_back(
          {std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)});
      share.push_back(0.5 * (1.0 + std::cos(tilt)));
    }
  }
  for (const int directions : {1, 4}) {
    const SharedElements elements(divided(*sky, "tregenza"), nullptr, directions);
    Progress quiet;
    const auto light = elements.light(rays, sensors, quiet);
    for (std::size_t s = 0; s < share.size(); ++s) {
      worst.add(light.lux[s] / (3000.0 * kPi * share[s]) - 1.0, std::to_string(s));
      EXPECT_NEAR(light.sky_view[s], share[s], 2e-3);
    }
  }
  EXPECT_LE(worst.worst(), 2e-3);  // midpoint rule, 24 x 24 parts of an element that is cut
}

// 2,048 elements of 0.003 sr: what their edges cut off is lost or won by the element.
TEST(SharedElements, StreetsCourtsAndBlocksAreLitAsTheirClosedFormsSay) {
  double squares = 0.0, worst = 0.0, engines = 0.0;
  std::size_t count = 0;
  for (const auto& one : testing_support::obstructed_cases()) {
    const int type = std::stoi(one.name.substr(one.name.rfind(' ') + 1));
    const auto sky = testing_support::numbered_sky(type, 40.0, 180.0);
    const SharedElements elements(divided(*sky, "uniform", 2048));
    const RayVisibility rays(one.scene->soup, one.scene->materials);
    const ShadowMaps maps(one.scene->soup, one.scene->materials, software(64));
    const Sensors sensors = lifted(one.sensors, rays.lift_m());
    const double open = one.source->unobstructed_lux();
    Progress quiet;
    const auto by_rays = elements.light(rays, sensors, quiet);
    const auto by_maps = elements.light(maps, sensors, quiet);
    for (std::size_t s = 0; s < sensors.size(); ++s) {
      const double error = by_maps.lux[s] / open - one.ratio[s];
      squares += error * error;
      worst = std::max(worst, std::abs(error));
      engines = std::max(engines, std::abs(by_maps.lux[s] - by_rays.lux[s]) / open);
      ++count;
    }
  }
  const double rms = std::sqrt(squares / static_cast<double>(count));
  std::printf(
      "[ MEASURED ] shared directions, 2048 elements, closed forms: rms %.3g, worst %.3g of "
      "the open sky (%zu values); engines differ by %.3g at most\n",
      rms, worst, count, engines);
  // Edges cross about 2 sqrt(2048) elements; each is wrong by 0.3 of itself, one way or the other.
  EXPECT_LE(rms, 0.005);
  EXPECT_LE(engines, 0.005);
}

TEST(SharedElements, ResultsDoNotDependOnTheThreads) {
  TestScene scene = pavement();
  scene.box({-10, -5, 0}, {20, 10, 15}, 30.0);
  const auto sky = testing_support::numbered_sky(12, 40.0, 180.0);
  const SharedElements elements(divided(*sky, "adaptive", 60), nullptr, 2);
  Sensors sensors;
  for (int k = 0; k < 9000; ++k) {
    sensors.position.push_back({-45.0 + k % 90, -45.0 + k / 100.0, 1e-5});
    sensors.normal.push_back(k % 7 == 0 ? Vec3{0.6, 0, 0.8} : kZenith);
  }
  const RayVisibility rays(scene.soup, scene.materials);
  const ShadowMaps maps(scene.soup, scene.materials, software(128));
  for (const Visibility* engine :
       {static_cast<const Visibility*>(&rays), static_cast<const Visibility*>(&maps)}) {
    const auto run = [&](unsigned threads) {
      const ThreadLimit limit(threads);
      Progress quiet;
      return elements.light(*engine, sensors, quiet);
    };
    const auto one = run(1), two = run(2);
    EXPECT_EQ(one.lux, two.lux);
    EXPECT_EQ(one.sky_view, two.sky_view);
  }
}

// The part of a disc above a chord at a share h of its radius: (acos h - h sqrt(1 - h^2)) / pi.
TEST(SharedElements, SunDiscGivesThePenumbraOfAStraightEdge) {
  TestScene scene;
  scene.level({-20, -20, 20, 20}, 0.0);
  scene.wall({-2000, 10, 2000, 10}, 0, 10);
  const ShadowMaps maps(scene.soup, scene.materials, software(64));
  SolarDisc sun;
  sun.direction = normalized(Vec3{0, 1, 1});
  sun.normal_illuminance = Illuminance(100000.0);
  const std::vector<double> shares{-0.9, -0.5, 0.0, 0.5, 0.9};
  Sensors sensors;
  for (const double share : shares) {
    const double distance = 10.0 / std::tan(kPi / 4 + share * sun.angular_radius.in_radians());
    sensors.position.push_back({0, 10 - distance, 1e-5});
    sensors.normal.push_back(kZenith);
  }
  constexpr int kDirections = 128;
  const auto lux = shared_sun_lux(maps, sensors, sun, kDirections);
  for (std::size_t s = 0; s < shares.size(); ++s) {
    const double h = shares[s], truth = (std::acos(h) - h * std::sqrt(1 - h * h)) / kPi;
    EXPECT_NEAR(lux[s] / (100000.0 * std::sqrt(0.5)), truth, 0.015) << h;
  }
}

TEST(SharedElements, NoDirectionsAreRefused) {
  const auto sky = testing_support::numbered_sky(5, 40.0, 180.0);
  EXPECT_THROW(SharedElements(divided(*sky, "tregenza"), nullptr, 0), InputError);
}

}  // namespace
}  // namespace tenku
