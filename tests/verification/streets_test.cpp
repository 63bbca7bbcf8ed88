// City streets with reflected light against Radiance's converged values.
#include <gtest/gtest.h>

#include "scene/flatten.h"
#include "scene/read_scene.h"
#include "support/measured.h"
#include "support/reference_table.h"
#include "support/test_scene.h"

namespace tenku {
namespace {

using testing_support::ReferenceTable;
using testing_support::WorstError;

const std::string kFolder = TENKU_TEST_REFERENCE "/illuminance/streets";
constexpr double kSunAltitude = 40.0, kSunAzimuth = 210.0;

Scene streets() {
  ReadOptions options;
  options.materials = kFolder + "/streets.toml";
  Progress quiet;
  return read_scene(kFolder + "/streets.obj", options, quiet);
}

DaylightSource sun_alone() {
  DaylightSource source;
  source.sun.direction = direction_from(Angle::degrees(kSunAzimuth), Angle::degrees(kSunAltitude));
  source.sun.normal_illuminance = Illuminance(80000.0);
  return source;
}

/// Every fourth sensor of one case, of ten reflections and of one light.
void compare(const std::string& name, const DaylightSource& source, double table_horizontal_lux) {
  constexpr std::size_t kStep = 4;
  const ReferenceTable table(kFolder + "/" + name + ".csv");
  const Scene scene = streets();
  const TriangleSoup soup = flatten(scene);
  const RayVisibility rays(soup, scene.materials);
  Sensors sensors;
  for (std::size_t row = 0; row < table.size(); row += kStep) {
    const auto at = [&](const char* column) { return table.number(row, column); };
    sensors.position.push_back(scene.frame.to_local({at("x"), at("y"), at("z")}));
    sensors.normal.push_back(scene.frame.direction_to_local({at("nx"), at("ny"), at("nz")}));
  }
  auto options = testing_support::direct_options(1.0);
  options.bounces = 10;
  Progress quiet;
  const auto result = illuminate(sensors, rays, source, options, quiet);
  const double scale = source.unobstructed_lux() / table_horizontal_lux;
  WorstError worst("streets, " + name + ", tolerance 1, 10 bounces, percent");
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const double truth = scale * table.number(i * kStep, "total_lux");
    ASSERT_GT(truth, 0.01 * source.unobstructed_lux());
    worst.add(100.0 * (result.values.total_lux(i) / truth - 1.0), std::to_string(i * kStep));
  }
  EXPECT_LE(worst.worst(), 2.0);
}

TEST(Streets, UnderAnOvercastSkyAreAsBrightAsInRadiance) {
  compare("overcast",
          testing_support::source_of(*testing_support::numbered_sky(16, kSunAltitude, kSunAzimuth)),
          10000.0);
}

TEST(Streets, UnderAClearSkyAreAsBrightAsInRadiance) {
  compare("clear",
          testing_support::source_of(*testing_support::numbered_sky(12, kSunAltitude, kSunAzimuth)),
          10000.0);
}

TEST(Streets, InSunlightAreAsBrightAsInRadiance) {
  compare("sun", sun_alone(), 80000.0 * std::sin(kSunAltitude * kPi / 180.0));
}

}  // namespace
}  // namespace tenku
