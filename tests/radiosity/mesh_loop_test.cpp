// Meshes made to suit the light: fewer elements, no lost shadows.
#include "radiosity/mesh_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "meshing/mesh_checks.h"
#include "support/measured.h"

namespace tenku {
namespace {

using testing_support::Surface;

/// A floor under a lamp, with something between that throws a shadow.
struct ShadowScene {
  Surface surface;

  ShadowScene() {
    surface.materials.assign(3, Material{});
    surface.materials[0].reflectance = Rgb::grey(0.5);
    surface.materials[1].reflectance = Rgb::grey(0.0);
    surface.materials[1].emission_lm_m2 = Rgb::grey(5000.0);
    surface.materials[2].reflectance = Rgb::grey(0.2);
  }
  void lamp(double x0, double y0, double x1, double y1, double z) {
    surface.material = 1;
    surface.level(x0, y0, x1, y1, z);
    surface.material = 0;
  }
  MeshLoop loop(double element_m, MeshLoopOptions options, double tolerance_pct = 5.0) const {
    Scene scene;
    scene.materials = surface.materials;
    scene.objects.resize(1);
    InteriorOptions how;
    how.tolerance_pct = tolerance_pct;
    return {mesh_scene(scene, surface.soup, {.element_m = element_m}), surface.materials, how,
            std::move(options)};
  }
};

ShadowScene plate_over_floor() {
  ShadowScene scene;
  scene.surface.level(-2, -2, 2, 2);
  scene.surface.level(-0.4, -0.4, 0.4, 0.4, 0.4);
  scene.lamp(-0.1, -0.1, 0.1, 0.1, 2.0);
  return scene;
}

TEST(MeshLoop, SplitsWhereNeighboursDiffer) {
  const ShadowScene scene = plate_over_floor();
  MeshLoopOptions how;
  how.mesher = Mesher::Refine;
  how.elements_max = 2000;
  how.rounds = 2;
  how.tolerance_pct = 0.01;
  how.threshold_pct = 5.0;
  MeshLoop loop = scene.loop(0.4, how);
  Progress quiet;
  loop.run({}, quiet);
  ASSERT_EQ(loop.rounds().size(), 3U);
  EXPECT_LE(loop.mesh().size(), 2000U);
  EXPECT_LT(loop.rounds()[2].missed_pct, loop.rounds()[0].missed_pct);
  EXPECT_GT(loop.rounds()[1].elements, loop.rounds()[0].elements);
  EXPECT_NEAR(testing_support::area_of(loop.mesh()), 16.0 + 0.64 + 0.04, 1e-9);
}

TEST(MeshLoop, OfBubblesMissesLessWithFewerElements) {
  const ShadowScene scene = plate_over_floor();
  MeshLoopOptions how;
  how.mesher = Mesher::Bubble;
  how.elements_max = 1200;
  how.rounds = 1;
  how.tolerance_pct = 0.01;
  MeshLoop loop = scene.loop(0.15, how);
  Progress quiet;
  loop.run({}, quiet);
  ASSERT_EQ(loop.rounds().size(), 2U);
  EXPECT_GT(loop.rounds()[0].elements, 1500U);
  EXPECT_LE(loop.mesh().size(), 1200U);
  EXPECT_LT(loop.rounds()[1].missed_pct, loop.rounds()[0].missed_pct);
  EXPECT_NEAR(testing_support::area_of(loop.mesh()), 16.0 + 0.64 + 0.04, 1e-6);
  EXPECT_EQ(loop.asked_size_m().size(), loop.mesh().vertices.size());
}

TEST(MeshLoop, EndsWhenTheToleranceHolds) {
  const ShadowScene scene = plate_over_floor();
  MeshLoopOptions how;
  how.mesher = Mesher::Bubble;
  how.tolerance_pct = 90.0;
  MeshLoop loop = scene.loop(0.3, how);
  Progress quiet;
  loop.run({}, quiet);
  EXPECT_EQ(loop.rounds().size(), 1U);
}

TEST(MeshLoop, RefusesWhatCannotBe) {
  const ShadowScene scene = plate_over_floor();
  MeshLoopOptions how;
  how.mesher = Mesher::Bubble;
  how.sizes = {0.5, 0.1};
  EXPECT_THROW(scene.loop(0.5, how), InputError);
  how.sizes = {};
  how.tolerance_pct = 0.0;
  EXPECT_THROW(scene.loop(0.5, how), InputError);
  EXPECT_THROW((void)mesher_named("bubbles"), InputError);
}

}  // namespace
}  // namespace tenku
