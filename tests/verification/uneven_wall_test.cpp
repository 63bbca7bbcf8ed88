// Before a wall of the sample town whose facets stand a tenth of a millimetre before and behind one
// another: the light of many runs against that of many directions, and against even slices.
#include <gtest/gtest.h>

#include <cmath>

#include "illuminance/sensor_sky.h"
#include "scene/flatten.h"
#include "scene/read_scene.h"
#include "support/test_scene.h"
#include "verification/reference_cases.h"

namespace tenku {
namespace {

TEST(UnevenWall, HasTheSameSkylightByAllSlices) {
  Progress silent;
  const Scene scene =
      read_scene(TENKU_SOURCE_DIR "/scenes/examples/sapporo_town.city.json", {}, silent);
  const TriangleSoup soup = flatten(scene);
  const RayVisibility rays(soup, scene.materials);
  const auto sky = testing_support::numbered_sky(12, 51.0, 115.0);
  const SkyTable table(*sky);
  const Vec3 position = scene.frame.to_local({-73319.91846, -104023.89456, 16.95551});
  const Vec3 normal =
      scene.frame.direction_to_local({0.9859951030031906, 0.16677151493328538, 0.00095846783});
  PartitionRequest uniform = parse_partition("uniform");
  uniform.elements = 16'000;
  const double expected =
      ElementSky(*sky, partition_sky(*sky, uniform))
          .light(rays, position + rays.lift_m() * normal, normal, SampleRandom(1, 0, 0))
          .lux;
  SensorSky even(rays, &table, position, normal, SampleRandom(1, 0, 0),
                 SensorSky::Effort{.outlined = false});
  while (even.slices() < 4000) even.refine();
  EXPECT_NEAR(even.lux(), expected, 0.005 * expected);
  for (std::uint64_t run = 0; run < 60; ++run) {
    SensorSky found(rays, &table, position, normal, SampleRandom(1, run, 0));
    const auto wanted = [&] { return std::pow(0.005 * found.lux(), 2); };
    do {
      found.refine(wanted());
    } while (found.may_miss_openings() || found.variance() > wanted());
    EXPECT_NEAR(found.lux(), expected, 3.0 * std::sqrt(found.variance()) + 0.005 * expected) << run;
  }
}

}  // namespace
}  // namespace tenku
