// Panes inside rooms: a closed form, and paths through the same room.
#include <gtest/gtest.h>

#include <cstdio>

#include "form_factors/form_factor.h"
#include "meshing/mesh_surfaces.h"
#include "radiosity/solver_scene.h"
#include "support/test_scene.h"

namespace tenku {
namespace {

using namespace testing_support;

/// Of light that comes evenly from all sides to a clear pane of index 1.52: integral of
/// 2 mu T(mu) over the cosine mu from 0 to 1, T by Fresnel's formulas for both faces, with
/// reflections between them; Simpson's rule with 20,000 steps in the root of mu, outside of this
/// program.
constexpr double kDiffuseTransmittance = 0.8464229;

Material clear_glass() {
  Material material;
  material.name = "glass";
  material.index = 1.52;
  return material;
}

/// Just over the floor of a room that shines evenly, under glass that reaches from wall to wall.
ElementMesh room_with_glass_over_floor() {
  SolverScene scene;
  const std::uint32_t wall = scene.grey(0.0, 100.0);
  scene.room({4, 4, 3}, {wall, wall, wall, wall, wall, wall}, 2.0);
  constexpr double kHeight = 0.001;
  scene.mesh.panes.materials = {clear_glass()};
  scene.mesh.panes.material = {0, 0};
  scene.mesh.panes.corner = {{{{0, 0, kHeight}, {4, 0, kHeight}, {4, 4, kHeight}}},
                             {{{0, 0, kHeight}, {4, 4, kHeight}, {0, 4, kHeight}}}};
  return scene.mesh;
}

TEST(Panes, HoldBackFromARowWhatFresnelsFormulasSay) {
  const ElementMesh mesh = room_with_glass_over_floor();
  for (const auto name : form_factor_method_names()) {
    const auto method = form_factor_method(name, mesh, {.resolution = 256});
    const Vec3 at{1.9, 2.1, method->lift_m()};
    double sum = 0.0;
    for (const FormFactor& f : method->from_point(at, kZenith)) sum += f.value;
    // Rays: the error of 51,000 strata. Others: of 16 points an element.
    EXPECT_NEAR(sum, kDiffuseTransmittance, 0.002) << name;
  }
}

/// A room of 6 x 4 x 3 m parted by glass at x = 3, with a lamp that hangs in its first half.
TestScene parted_room(bool has_glass) {
  TestScene scene;
  Material lamp = grey_material(0.0), glass = clear_glass();
  lamp.emission_lm_m2 = Rgb::grey(5000.0);
  scene.materials = {grey_material(0.5), grey_material(0.3), grey_material(0.7), lamp, glass};
  scene.level({0, 0, 6, 4}, 0, 1);
  scene.level({0, 0, 6, 4}, 3, 2);
  scene.wall({0, 0, 6, 0}, 0, 3);
  scene.wall({0, 4, 6, 4}, 0, 3);
  scene.wall({0, 0, 0, 4}, 0, 3);
  scene.wall({6, 0, 6, 4}, 0, 3);
  scene.begin_object();
  scene.wall({1.5, 1.5, 1.5, 2.5}, 1.0, 2.0, 3);
  if (has_glass) scene.wall({3, 0, 3, 4}, 0, 3, 4);
  return scene;
}

Sensors sensors_in_second_half() {
  Sensors sensors;
  for (int k = 0; k < 4; ++k) {
    sensors.position.push_back({3.5 + 0.6 * k, 1.0 + 0.6 * k, 0.8});
    sensors.normal.push_back(kZenith);
    sensors.position.push_back({5.5 - 0.4 * k, 2.0, 1.5});
    sensors.normal.push_back({-1, 0, 0});
    sensors.position.push_back({3.4 + 0.5 * k, 2.0, 2.0});
    sensors.normal.push_back({1, 0, 0});
  }
  return sensors;
}

SensorIlluminance by_radiosity(const TestScene& scene, const Sensors& sensors) {
  const ElementMesh mesh = mesh_surfaces(scene.soup, scene.materials, {.element_m = 0.4});
  Progress quiet;
  Interior interior(mesh, scene.materials, {});
  const InteriorLight light = interior.light({}, quiet);
  expect_balanced(light.shots.balance);
  InteriorSensors look = interior.look_from(sensors);
  SensorIlluminance values(sensors.size());
  interior.add_reflected(look, light, values, quiet);
  return values;
}

TEST(Panes, InARoomDimLightBetweenSurfacesAsForPaths) {
  const Sensors sensors = sensors_in_second_half();
  const SensorIlluminance dimmed = by_radiosity(parted_room(true), sensors),
                          open = by_radiosity(parted_room(false), sensors);
  IlluminanceOptions how = with_bounces(3.0, 20);  // what is left: 0.5^20
  const IlluminanceResult paths = illuminate(parted_room(true), sensors, DaylightSource{}, how);
  double worst = 0.0;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const double truth = paths.values.total_lux(i), lux = dimmed.reflected_lux[i];
    worst = std::max(worst, std::abs(lux / truth - 1.0));
    EXPECT_LE(std::abs(lux - truth), dimmed.error_lux[i] + paths.values.error_lux[i]) << i;
    EXPECT_LT(lux, 0.95 * open.reflected_lux[i]) << i;
  }
  std::printf("[ MEASURED ] behind glass, against paths: worst %.2f %%\n", 100.0 * worst);
  EXPECT_LE(worst, 0.02);
}

TEST(Panes, OfAFacadeAreNotBetweenItsSurfaces) {
  TestScene scene = parted_room(false);
  scene.wall({6, 1, 6, 3}, 1, 2, 4);  // in the wall: nothing of the scene is behind it
  EXPECT_TRUE(mesh_surfaces(scene.soup, scene.materials, {}).panes.empty());
  scene.wall({3, 1, 3, 3}, 1, 2, 4);
  EXPECT_EQ(mesh_surfaces(scene.soup, scene.materials, {}).panes.corner.size(), 2U);
}

}  // namespace
}  // namespace tenku
