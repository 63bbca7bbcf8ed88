// Daylight of a further sky, taken over from the first: against the integrator alone, which is
// tested against others' values elsewhere.

#include "radiosity/kept_daylight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "meshing/mesh_surfaces.h"
#include "radiosity/interior.h"
#include "support/side_lit_room.h"
#include "support/test_scene.h"

namespace tenku {
namespace {

using namespace testing_support;

/// On the work plane, on the north wall, and outside on the west wall.
Sensors sensors_in_room() {
  Sensors sensors;
  const auto add = [&](Vec3 at, Vec3 normal) {
    sensors.position.push_back(at);
    sensors.normal.push_back(normal);
  };
  for (int j = 0; j < 15; ++j) {
    for (int i = 0; i < 11; ++i) add({0.5 * (i + 1), 0.5 * (j + 1), 0.8}, kZenith);
    for (int i = 0; i < 5; ++i) add({0.4 * j + 0.2, 8.0, 0.55 * i + 0.3}, {0, -1, 0});
    for (int i = 0; i < 5; ++i) add({0.0, 0.5 * (j + 1), 0.55 * i + 0.3}, {-1, 0, 0});
  }
  return sensors;
}

DaylightSource source_with_model(const SkyModel& sky) {
  DaylightSource source = source_of(sky);
  source.model = &sky;
  return source;
}

IlluminanceResult light_of(KeptDaylight& kept, const Sensors& sensors, const Engines& engines,
                           const DaylightSource& source) {
  Progress quiet;
  return kept.light(sensors, {engines, source, direct_options(2.0), {}}, quiet);
}

void set_sun(DaylightSource& source, double altitude_deg, double azimuth_deg) {
  source.sun.direction = direction_from(Angle::degrees(azimuth_deg), Angle::degrees(altitude_deg));
  source.sun.angular_radius = Angle::degrees(0.2665);
  source.sun.normal_illuminance = Illuminance(60000.0);
}

/// Overcast, then clear with the sun to the south: how the values of the latter lie to those of the
/// integrator, eight times as exact.
void expect_as_alone(bool has_sun) {
  const TestScene scene = side_lit_room();
  const Engines engines(scene.soup, scene.materials);
  const Sensors sensors = sensors_in_room();
  const auto overcast = numbered_sky(16, 0.0, 0.0), clear = numbered_sky(12, 40.0, 160.0);
  DaylightSource second = source_with_model(*clear);
  if (has_sun) set_sun(second, 40.0, 160.0);
  KeptDaylight kept(true);
  light_of(kept, sensors, engines, source_with_model(*overcast));
  const IlluminanceResult found = light_of(kept, sensors, engines, second);
  EXPECT_LT(kept.found_anew(), sensors.size() / 4);
  const IlluminanceResult alone = illuminate(scene, sensors, second, direct_options(0.25, 7));
  const double floor_lux = 0.001 * second.unobstructed_lux();
  Coverage coverage;
  double worst = 0.0;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const double lux = alone.values.total_lux(i), here = found.values.total_lux(i);
    coverage.add(here, lux, std::hypot(found.values.error_lux[i], alone.values.error_lux[i]));
    worst = std::max(worst, std::abs(here - lux) / std::max(lux, floor_lux));
    EXPECT_LE(found.values.error_lux[i], 0.02 * std::max(here, floor_lux) + 1e-9);
  }
  std::printf("[ MEASURED ] further sky: %.1f %% inside, worst %.2f %%, %zu of %zu found anew\n",
              coverage.pct(), 100.0 * worst, kept.found_anew(), sensors.size());
  EXPECT_GE(coverage.pct(), 93.0);  // of 95, less two standard errors of 315
  EXPECT_LE(worst, 0.03);           // one value in 20 may miss 2 %, none by half as much again
}

TEST(KeptDaylight, OfAClearSkyIsThatOfTheIntegrator) { expect_as_alone(false); }

TEST(KeptDaylight, OfSunAndSkyIsThatOfTheIntegrator) { expect_as_alone(true); }

TEST(KeptDaylight, OfTheSameSkyTwiceAsBrightIsTwiceAsMuch) {
  const TestScene scene = side_lit_room();
  const Engines engines(scene.soup, scene.materials);
  const Sensors sensors = sensors_in_room();
  const CieOvercastSky dim(Luminance(3000.0)), bright(Luminance(6000.0));
  KeptDaylight kept(true);
  const auto one = light_of(kept, sensors, engines, source_with_model(dim));
  const auto two = light_of(kept, sensors, engines, source_with_model(bright));
  EXPECT_EQ(kept.found_anew(), 0U);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    EXPECT_NEAR(two.values.sky_lux[i], 2.0 * one.values.sky_lux[i], 1e-5 * one.values.sky_lux[i]);
  }
}

/// All light of a room under a clear sky, either at once or after an overcast and another one.
class SkiesOfARoom {
 public:
  SkiesOfARoom()
      : scene_(side_lit_room()),
        mesh_(mesh_surfaces(scene_.soup, scene_.materials, {.element_m = 1.0})),
        engines_(scene_.soup, scene_.materials) {}

  InteriorLight light(bool after_others) {
    InteriorOptions how;
    how.many_skies = true;
    Interior interior(mesh_, scene_.materials, how);
    if (after_others) {
      light_of(interior, 16, 40.0, 160.0);
      light_of(interior, 5, 40.0, 160.0);
    }
    return light_of(interior, 12, 35.0, 200.0);
  }

 private:
  InteriorLight light_of(Interior& interior, int sky, double altitude_deg, double azimuth_deg) {
    const auto model = numbered_sky(sky, altitude_deg, azimuth_deg);
    const DaylightSource source = source_with_model(*model);
    const DaylightMethod daylight{engines_, source, direct_options(2.0), {}};
    Progress quiet;
    return interior.light({&daylight, 1.0}, quiet);
  }

  TestScene scene_;
  ElementMesh mesh_;
  Engines engines_;
};

TEST(FurtherSky, InARoomGivesTheLightThatItGivesAlone) {
  SkiesOfARoom room;
  const InteriorLight further = room.light(true), alone = room.light(false);
  double mean = 0.0;
  const std::size_t count = alone.points.size();
  for (std::size_t i = 0; i < count; ++i) mean += alone.points.total_lux(i) / count;
  double squares = 0.0, worst = 0.0;
  Coverage coverage;
  for (std::size_t i = 0; i < count; ++i) {
    const double lux = alone.points.total_lux(i);
    if (!(lux > 0.0)) continue;
    const double away = std::abs(further.points.total_lux(i) - lux);
    coverage.add(away, 0.0, std::hypot(further.points.error_lux[i], alone.points.error_lux[i]));
    const double share = away / std::max(lux, 0.1 * mean);
    worst = std::max(worst, share);
    squares += share * share;
  }
  const double rms = std::sqrt(squares / static_cast<double>(coverage.count()));
  std::printf("[ MEASURED ] further sky in a room: RMS %.2f %%, worst %.2f %%, %.1f %% inside\n",
              100.0 * rms, 100.0 * worst, coverage.pct());
  EXPECT_GE(coverage.pct(), 95.0);
  EXPECT_LE(rms, 0.01);
  EXPECT_LE(worst, 0.03);
}

}  // namespace
}  // namespace tenku
