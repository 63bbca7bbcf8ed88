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

/// Light from above on a place of a level floor, linear between the corners of its element.
double lux_at(const MeshLoop& loop, Vec3 p) {
  const ElementMesh& mesh = loop.mesh();
  const LightOnMesh light = light_on_mesh(mesh, loop.interior(), loop.light());
  for (std::size_t e = 0; e < mesh.size(); ++e) {
    const auto [a, b, c] = mesh.elements[e];
    const Vec3 area = mesh.doubled_area(e);
    if (std::abs(mesh.vertices[a].z - p.z) > 1e-9) continue;
    const auto share = [&](std::uint32_t u, std::uint32_t v) {
      return dot(cross(mesh.vertices[v] - mesh.vertices[u], p - mesh.vertices[u]), area) /
             dot(area, area);
    };
    const double at_a = share(b, c), at_b = share(c, a), at_c = share(a, b);
    if (std::min({at_a, at_b, at_c}) < 0.0) continue;
    const std::size_t side = 2 * e + (area.z > 0.0 ? 0 : 1);
    const auto& corner = light.points.corner[side];
    return at_a * light.lux[corner[0]] + at_b * light.lux[corner[1]] + at_c * light.lux[corner[2]];
  }
  return -1.0;
}

TEST(MeshLoop, KeepsFormFactorsOfWhatSeesNoOtherMesh) {
  // Beside the shadow a room of its own, closed, dim and evenly lit: its mesh stays.
  ShadowScene scene = plate_over_floor();
  for (const double z : {0.0, 2.0}) scene.surface.level(10, 10, 12, 12, z);
  for (const double at : {10.0, 12.0}) {
    scene.surface.fan({{at, 10, 0}, {at, 12, 0}, {at, 12, 2}, {at, 10, 2}});
    scene.surface.fan({{10, at, 0}, {12, at, 0}, {12, at, 2}, {10, at, 2}});
  }
  scene.surface.materials[2].emission_lm_m2 = Rgb::grey(0.1);
  scene.surface.material = 2;
  scene.surface.level(10.9, 10.9, 11.1, 11.1, 1.9);
  MeshLoopOptions how;
  how.mesher = Mesher::Bubble;
  how.rounds = 1;
  how.tolerance_pct = 1.0;
  how.sizes.most_m = 0.25;
  MeshLoop loop = scene.loop(0.25, how);
  Progress quiet;
  loop.run({}, quiet);
  ASSERT_EQ(loop.rounds().size(), 2U);
  EXPECT_GT(loop.rounds()[1].polygons_meshed, 0U);
  InteriorOptions same;
  same.tolerance_pct = 5.0;
  Interior anew(loop.mesh(), scene.surface.materials, same);
  const InteriorLight light = anew.light({}, quiet);
  for (std::size_t i = 0; i < anew.points().size(); ++i) {
    // What is kept looks as finely as it did before, what is found anew no finer than it must.
    EXPECT_NEAR(loop.light().points.total_lux(i), light.points.total_lux(i),
                light.points.error_lux[i] + loop.light().points.error_lux[i] + 1e-9);
  }
  // The lamp in the room is divided anew: points whose rays meet it look again.
  EXPECT_GT(loop.rounds()[1].points_kept, 600U);
  EXPECT_LT(loop.rounds()[1].points_kept, anew.points().size() / 3);
}

TEST(MeshLoop, KeepsTheShadowOfABarInFewerElements) {
  // A bar 2 cm wide, askew, 20 cm above the floor of a room of 6 m; its umbra is 1.7 cm wide.
  ShadowScene scene;
  scene.surface.level(-3, -3, 3, 3);
  const Vec3 along = normalized(Vec3{3, 1, 0}), across = {-along.y, along.x, 0};
  const Vec3 middle{0.4, 0.5, 0.2};
  const auto corner = [&](double u, double v) { return middle + u * along + v * across; };
  scene.surface.fan(
      {corner(-0.6, -0.01), corner(0.6, -0.01), corner(0.6, 0.01), corner(-0.6, 0.01)});
  scene.lamp(-0.025, -0.025, 0.025, 0.025, 2.8);
  MeshLoopOptions how;
  how.mesher = Mesher::Bubble;
  how.elements_max = 4000;
  how.rounds = 2;
  how.tolerance_pct = 0.01;
  MeshLoop loop = scene.loop(0.08, how, 20.0);
  Progress quiet;
  loop.run({}, quiet);
  EXPECT_GT(loop.rounds()[0].elements, 20000U);
  EXPECT_LE(loop.mesh().size(), 4000U);
  int dark = 0, places = 0;
  const Vec3 lamp{0, 0, 2.8};
  for (double u = -0.5; u <= 0.5; u += 0.05) {
    // The shadow's middle, and a place beside it: 2.8 m over 2.6 m from the lamp.
    const auto shadow = [&](double v) { return lamp + 2.8 / 2.6 * (corner(u, v) - lamp); };
    Vec3 in = shadow(0.0), beside = shadow(0.2);
    in.z = beside.z = 0.0;
    dark += lux_at(loop, in) < 0.5 * lux_at(loop, beside);
    ++places;
  }
  EXPECT_GE(dark, places * 9 / 10);
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
