// Sunlight: shadows of boxes and the penumbra of an edge, against closed forms.
#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>

#include "core/random.h"
#include "support/measured.h"
#include "support/reference_table.h"
#include "support/test_scene.h"

namespace tenku {
namespace {

using testing_support::Coverage;
using testing_support::ReferenceTable;
using testing_support::TestScene;
using testing_support::WorstError;

DaylightSource sun_alone(double altitude_deg, double azimuth_deg) {
  DaylightSource source;
  source.sun.direction = direction_from(Angle::degrees(azimuth_deg), Angle::degrees(altitude_deg));
  source.sun.normal_illuminance = Illuminance(80000.0);
  return source;
}

/// Distance from the boundary of a convex polygon given counter-clockwise, positive inside.
double depth_inside(const std::vector<Vec3>& hull, Vec3 p) {
  double depth = 1e9;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec3 a = hull[i], along = normalized(hull[(i + 1) % hull.size()] - a);
    depth = std::min(depth, cross(along, p - a).z);
  }
  return depth;
}

TEST(SunLight, IsWholeOutsideTheShadowOfABoxAndNoneInsideIt) {
  const ReferenceTable table(TENKU_TEST_REFERENCE "/illuminance/box_shadow.csv");
  WorstError worst("sunlight beside and in the shadow of a box, relative");
  for (std::size_t row = 0; row < table.size(); ++row) {
    const auto number = [&](const char* name) { return table.number(row, name); };
    TestScene scene;
    scene.box({number("x0"), number("y0"), 0}, {number("w"), number("d"), number("h")},
              number("turn"));
    std::vector<Vec3> hull;
    std::istringstream corners(table.text(row, "hull"));
    for (Vec3 p; corners >> p.x >> p.y;) hull.push_back(p);
    const double altitude = number("altitude"), z = number("z");
    const auto source = sun_alone(altitude, number("azimuth"));
    const double radius_deg = source.sun.angular_radius.in_degrees();
    const auto cot = [](double degrees) { return 1.0 / std::tan(degrees * kPi / 180.0); };
    const double margin = 1.1 * number("h") * (cot(altitude - radius_deg) - cot(altitude)) + 0.01;
    Sensors sensors;
    std::vector<bool> lit;
    SampleRandom random(5, row, 0);
    while (sensors.size() < 100) {
      const double reach = 2.0 * number("h") * cot(altitude) + 30.0;
      const Vec3 p{hull[0].x + reach * (2.0 * random.uniform() - 1.0),
                   hull[0].y + reach * (2.0 * random.uniform() - 1.0), 0.0};
      const double depth = depth_inside(hull, p);
      if (std::abs(depth) < margin) continue;
      sensors.position.push_back({p.x, p.y, z});
      sensors.normal.push_back(kZenith);
      lit.push_back(depth < 0.0);
    }
    const auto result = illuminate(scene, sensors, source, testing_support::direct_options(1.0));
    const double whole = 80000.0 * std::sin(altitude * kPi / 180.0);
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      worst.add((result.values.total_lux(i) - (lit[i] ? whole : 0.0)) / whole,
                "row " + std::to_string(row));
    }
  }
  EXPECT_LE(worst.worst(), 1e-9);
}

/// Part of a disc of radius 1 on one side of a chord at the distance `t` beyond its centre.
double part_of_disc(double t) {
  if (t >= 1.0) return 1.0;
  if (t <= -1.0) return 0.0;
  return 1.0 - (std::acos(t) - t * std::sqrt(1.0 - t * t)) / kPi;
}

TEST(SunLight, InThePenumbraOfAnEdgeIsThatOfADiscCutByAChord) {
  constexpr double kHeight = 100.0;
  TestScene scene;
  scene.level({-500, -500, 0, 500}, kHeight);
  auto source = sun_alone(90.0, 0.0);
  const double radius = kHeight * std::tan(source.sun.angular_radius.in_radians());
  Sensors sensors;
  std::vector<double> truth;
  for (double t = -0.95; t < 0.96; t += 0.05) {
    sensors.position.push_back({t * radius, 3.0, 0.0});
    sensors.normal.push_back(kZenith);
    truth.push_back(80000.0 * part_of_disc(t));
  }
  for (const double tolerance : {5.0, 2.0, 1.0}) {
    Coverage coverage;
    WorstError worst("penumbra, tolerance " + std::to_string(tolerance).substr(0, 3) +
                     ", percent of the whole sun");
    for (std::uint64_t seed = 1; seed < 30; ++seed) {
      auto options = testing_support::direct_options(tolerance, seed);
      const auto result = illuminate(scene, sensors, source, options);
      for (std::size_t i = 0; i < truth.size(); ++i) {
        worst.add((result.values.total_lux(i) - truth[i]) / 800.0, std::to_string(i));
        coverage.add(result.values.total_lux(i), truth[i], result.values.error_lux[i]);
      }
    }
    std::printf("[ MEASURED ] interval, penumbra, tolerance %g: holds %.1f %% of %zu\n", tolerance,
                coverage.pct(), coverage.count());
    EXPECT_LE(worst.worst(), tolerance);
    EXPECT_GE(coverage.pct(), 93.0);
  }
}

}  // namespace
}  // namespace tenku
