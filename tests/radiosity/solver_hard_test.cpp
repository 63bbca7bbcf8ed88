// Where the solver is tried: energy, threads, bright walls, gaps, wrong sides, darkness, nearness.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/parallel.h"
#include "radiosity/solver_scene.h"
#include "support/measured.h"

namespace tenku {
namespace {

using testing_support::expect_balanced;
using testing_support::SolverScene;

/// Room of 4 x 3 x 2.5 m with a lamp below its ceiling and a table.
SolverScene furnished_room(double per_m = 2.0) {
  SolverScene scene;
  const std::uint32_t wall = scene.material({0.6, 0.5, 0.4}),
                      wood = scene.material({0.4, 0.3, 0.2}),
                      lamp = scene.material(Rgb::grey(0.8), {900.0, 1000.0, 700.0});
  scene.room({4, 3, 2.5}, {wood, wall, wall, wall, wall, wall}, per_m);
  scene.quad({{{1.5, 1.2, 2.4}, {2.5, 1.2, 2.4}, {2.5, 1.8, 2.4}, {1.5, 1.8, 2.4}}}, {2, 1}, lamp);
  scene.quad({{{0.5, 0.5, 0.8}, {1.7, 0.5, 0.8}, {1.7, 1.5, 0.8}, {0.5, 1.5, 0.8}}}, {3, 2}, wood);
  return scene;
}

TEST(RadiosityEnergy, IsNeitherMadeNorLost) {
  for (const bool open : {false, true}) {
    SolverScene scene = furnished_room();
    if (open) {  // without the wall y = 3
      auto& mesh = scene.mesh;
      SolverScene opened;
      opened.materials = scene.materials;
      opened.room({4, 3, 2.5}, {1, 0, 0, 0, 0, 0}, 2.0);
      opened.mesh.elements.resize(opened.mesh.size() - 80);
      opened.mesh.material.resize(opened.mesh.size());
      opened.mesh.object.resize(opened.mesh.size());
      opened.mesh.patch_begin.resize(opened.mesh.patch_begin.size() - 40);
      opened.quad({{{1, 1, 2}, {2, 1, 2}, {2, 2, 2}, {1, 2, 2}}}, {2, 2}, 2);
      mesh = opened.mesh;
    }
    const LightBalance b = scene.light().shots.balance;
    expect_balanced(b);
    EXPECT_GT(b.emitted_lm, 0.0);
    EXPECT_LE(std::abs(b.emitted_lm - b.absorbed_lm - b.escaped_lm), 0.001 * b.emitted_lm);
    if (open) {
      EXPECT_GT(b.escaped_lm, 0.05 * b.emitted_lm);
    } else {
      EXPECT_LE(b.escaped_lm, 1e-4 * b.emitted_lm);
      EXPECT_GE(b.escaped_lm, 0.0);
    }
  }
}

TEST(RadiosityThreads, GiveTheSameBits) {
  const SolverScene scene = furnished_room();
  std::vector<InteriorLight> lights;
  for (const unsigned threads : {1U, 2U, 5U}) {
    const ThreadLimit limit(threads);
    lights.push_back(scene.light());
  }
  for (const InteriorLight& light : lights) {
    EXPECT_EQ(light.shots.shots, lights[0].shots.shots);
    EXPECT_EQ(light.corners.radiosity, lights[0].corners.radiosity);
    EXPECT_EQ(light.points.error_lux, lights[0].points.error_lux);
    EXPECT_EQ(light.shots.balance.escaped_lm, lights[0].shots.balance.escaped_lm);
  }
}

TEST(RadiosityThreads, DoNotMatterWhereRowsAreNotKept) {
  const SolverScene scene = furnished_room(1.0);
  InteriorOptions forgetful;
  forgetful.most_bytes = 100'000;
  const InteriorLight all = scene.light(), some = scene.light(forgetful);
  EXPECT_EQ(all.corners.radiosity, some.corners.radiosity);
  const auto is_told = [](const InteriorLight& light) {
    return std::any_of(light.findings.begin(), light.findings.end(),
                       [](const Finding& f) { return f.code == "form_factors_not_kept"; });
  };
  EXPECT_TRUE(is_told(some));
  EXPECT_FALSE(is_told(all));
}

TEST(RadiosityOfAnotherLight, IsThatOfAFreshCalculation) {
  const SolverScene scene = furnished_room();
  Progress quiet;
  Interior kept(scene.mesh, scene.materials, {}), fresh(scene.mesh, scene.materials, {});
  kept.light({}, quiet);
  LightRequest dimmed;
  dimmed.lamp_scale = 0.3;
  const InteriorLight again = kept.light(dimmed, quiet), first = fresh.light(dimmed, quiet);
  // Corners that the first light has made look more finely still do: nearly the same bits.
  for (std::size_t i = 0; i < first.points.size(); ++i) {
    const double lux = first.points.reflected_lux[i];
    EXPECT_NEAR(again.points.reflected_lux[i], lux, 0.002 * lux);
  }
  expect_balanced(again.shots.balance);
}

TEST(RadiosityOfBrightWalls, IsWithinItsStatedError) {
  SolverScene scene;  // the furnace: 1 / (1 - 0.99) of its emission
  const std::uint32_t wall = scene.grey(0.99, 1.0);
  scene.room({3, 3, 3}, {wall, wall, wall, wall, wall, wall}, 1.0);
  InteriorOptions options;
  options.tolerance_pct = 5.0;
  const InteriorLight light = scene.light(options);
  expect_balanced(light.shots.balance);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < light.points.size(); ++i) {
    if (!(light.points.reflected_lux[i] > 0.0)) continue;  // the outside
    ++inside;
    EXPECT_NEAR(light.points.reflected_lux[i], 100.0, light.points.error_lux[i]);
    EXPECT_LE(light.points.error_lux[i], 5.0);
  }
  EXPECT_EQ(inside, 6U * 16U);
  options.most_shots = 10;  // stopped early: that is told, and the bound holds all the same
  const InteriorLight early = scene.light(options);
  EXPECT_EQ(early.shots.shots, 10U);
  EXPECT_FALSE(early.shots.is_converged);
  double received = 0.0;
  for (std::size_t s = 0; s < scene.mesh.sides(); s += 2) {
    received += scene.mesh.area_m2(s / 2) * luminance_of(early.shots.sides.received[s]);
  }
  const double truth = 100.0 * 54.0;  // lm on 54 m2
  EXPECT_LE(truth - received, early.shots.left_lm);
  EXPECT_GT(truth - received, 0.0);
}

TEST(RadiosityOfALeakyRoom, TellsWhereTheLightEscapes) {
  for (const double gap : {0.0, 0.02}) {
    SolverScene scene;
    const std::uint32_t wall = scene.grey(0.5, 10.0);
    const double h = 2.5;
    scene.quad({{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}}}, {8, 6}, wall);
    scene.quad({{{0, 0, h}, {4, 0, h}, {4, 3, h}, {0, 3, h}}}, {8, 6}, wall);
    scene.quad({{{0, 0, 0}, {0, 3, 0}, {0, 3, h}, {0, 0, h}}}, {6, 5}, wall);
    scene.quad({{{4, 0, gap}, {4, 3, gap}, {4, 3, h}, {4, 0, h}}}, {6, 5}, wall);
    scene.quad({{{0, 0, 0}, {4, 0, 0}, {4, 0, h}, {0, 0, h}}}, {8, 5}, wall);
    scene.quad({{{0, 3, 0}, {4, 3, 0}, {4, 3, h}, {0, 3, h}}}, {8, 5}, wall);
    Progress quiet;
    Interior interior(scene.mesh, scene.materials, {});
    const InteriorLight light = interior.light({}, quiet);
    std::vector<double> lux;
    for (std::size_t i = 0; i < light.points.size(); ++i) lux.push_back(light.points.total_lux(i));
    const auto leaks = find_light_leaks(scene.mesh, interior.points().sensors, lux, 1e-5, 1);
    if (gap == 0.0) {
      EXPECT_TRUE(leaks.empty());
      continue;
    }
    ASSERT_FALSE(leaks.empty());
    EXPECT_NEAR(leaks[0].place.x, 4.0, 0.1);
    EXPECT_NEAR(leaks[0].place.z, gap / 2.0, 0.03);
    EXPECT_LE(leaks[0].width_m, 0.04);
    const auto told = std::find_if(light.findings.begin(), light.findings.end(),
                                   [](const Finding& f) { return f.code == "light_leak"; });
    ASSERT_NE(told, light.findings.end());
    EXPECT_NE(told->where.find("m east"), std::string::npos);
  }
}

TEST(RadiosityOfTurnedSurfaces, IsTheSame) {
  const SolverScene scene = furnished_room();
  SolverScene turned = scene;
  for (std::size_t e = 0; e < turned.mesh.size(); ++e) {
    if (turned.mesh.material[e] != 2)
      std::swap(turned.mesh.elements[e][1], turned.mesh.elements[e][2]);
  }
  const InteriorLight a = scene.light(), b = turned.light();
  for (std::size_t s = 0; s < scene.mesh.sides(); ++s) {
    const std::size_t other = scene.mesh.material[s / 2] == 2 ? s : s ^ 1U;
    const double one = luminance_of(a.corners.radiosity[s]);
    // Other directions are drawn: each may err by the tolerance of 2 %.
    EXPECT_NEAR(luminance_of(b.corners.radiosity[other]), one, 0.04 * one) << s;
  }
}

TEST(RadiosityWithoutLight, IsZero) {
  SolverScene scene;
  const std::uint32_t wall = scene.grey(0.5);
  scene.room({2, 2, 2}, {wall, wall, wall, wall, wall, wall}, 2.0);
  const InteriorLight light = scene.light();
  EXPECT_EQ(light.shots.shots, 0U);
  EXPECT_EQ(light.shots.balance.emitted_lm, 0.0);
  for (const Rgb b : light.corners.radiosity) EXPECT_EQ(b, Rgb{});
}

TEST(RadiosityOfPatches, WiderThanTheirDistanceIsThatOfPlates) {
  // Between wide plates B1 = M / (1 - rho^2): near the middle, 50 gaps from the edge.
  SolverScene scene;
  const double rho = 0.5, wide = 100.0;
  const std::uint32_t bright = scene.grey(rho, 1.0), dull = scene.grey(rho);
  for (const double z : {0.0, 1.0}) {
    scene.quad({{{0, 0, z}, {wide, 0, z}, {wide, wide, z}, {0, wide, z}}}, {20, 20},
               z == 0.0 ? bright : dull);
  }
  Progress quiet;
  Interior interior(scene.mesh, scene.materials, {});
  const InteriorLight light = interior.light({}, quiet);
  expect_balanced(light.shots.balance);
  Sensors sensors;
  sensors.position = {{wide / 2, wide / 2, 0.0}, {wide / 2, wide / 2, 1.0}};
  sensors.normal = {{0, 0, 1}, {0, 0, -1}};
  SensorIlluminance values(2);
  InteriorSensors look = interior.look_from(sensors);
  interior.add_reflected(look, light, values, quiet);
  const double b1 = 1.0 / (1.0 - rho * rho), b2 = rho * b1;
  EXPECT_NEAR(values.reflected_lux[0], b2, 0.005 * b2);
  EXPECT_NEAR(values.reflected_lux[1], b1, 0.005 * b1);
}

}  // namespace
}  // namespace tenku
