// Light by way of diffuse surfaces against closed forms and a room solved by radiosity.
#include <gtest/gtest.h>

#include "support/measured.h"
#include "support/reference_table.h"
#include "support/side_lit_room.h"
#include "support/test_scene.h"

namespace tenku {
namespace {

using testing_support::ReferenceTable;
using testing_support::TestScene;
using testing_support::with_bounces;
using testing_support::WorstError;

Material lamp(double exitance, double reflectance) {
  Material material = testing_support::grey_material(reflectance);
  material.emission_lm_m2 = Rgb::grey(exitance);
  return material;
}

TEST(ReflectedLight, InAGlowingFurnaceIsTheGeometricSeries) {
  WorstError worst("furnace, relative to the series as far as it is traced");
  for (const double rho : {0.2, 0.5, 0.8}) {
    TestScene scene;
    scene.materials[0] = lamp(1000.0, rho);
    scene.box({0, 0, 0}, {4, 5, 3});
    Sensors sensors;
    sensors.position = {{1, 2, 1}, {3.5, 0.5, 2.5}, {2, 2.5, 0}};
    sensors.normal = {kZenith, {1, 0, 0}, kZenith};
    for (const int bounces : {3, 6, 40}) {
      const auto result = illuminate(scene, sensors, {}, with_bounces(1.0, bounces));
      const double all = 1000.0 / (1.0 - rho), traced = all * (1.0 - std::pow(rho, bounces));
      for (std::size_t i = 0; i < sensors.size(); ++i) {
        worst.add(result.values.total_lux(i) / traced - 1.0,
                  std::to_string(rho) + " " + std::to_string(bounces));
        // What is left out is in the interval.
        EXPECT_LE(std::abs(result.values.total_lux(i) - all),
                  1.02 * result.values.error_lux[i] + 1e-6 * all)
            << rho << " " << bounces;
      }
    }
  }
  EXPECT_LE(worst.worst(), 0.01);
}

TEST(ReflectedLight, InAColouredFurnaceIsTheGeometricSeriesOfEachChannel) {
  TestScene scene;
  scene.materials[0] = lamp(0.0, 0.0);
  scene.materials[0].reflectance = {0.8, 0.5, 0.2};
  scene.materials[0].emission_lm_m2 = {100.0, 400.0, 1600.0};
  scene.box({0, 0, 0}, {4, 5, 3});
  Sensors sensors;
  sensors.position = {{1, 2, 1}, {3.5, 0.5, 2.5}};
  sensors.normal = {kZenith, {1, 0, 0}};
  const auto result = illuminate(scene, sensors, {}, with_bounces(1.0, 60));
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const Rgb found = result.values.reflected_rgb[i];
    EXPECT_NEAR(found.r / (100.0 / 0.2), 1.0, 0.02);
    EXPECT_NEAR(found.g / (400.0 / 0.5), 1.0, 0.02);
    EXPECT_NEAR(found.b / (1600.0 / 0.8), 1.0, 0.02);
    EXPECT_NEAR(luminance_of(found) / result.values.reflected_lux[i], 1.0, 1e-12);
  }
}

TEST(ReflectedLight, OfAGlowingPatchIsItsConfigurationFactor) {
  const ReferenceTable table(TENKU_TEST_REFERENCE "/illuminance/diffuse_patch.csv");
  for (const double half : {2.0, 250.0}) {
    WorstError worst("patch of half side " + std::to_string(half).substr(0, 5) + ", relative");
    TestScene scene;
    scene.materials[0] = lamp(10000.0, 0.0);
    scene.level({2 - half, 2 - half, 2 + half, 2 + half}, 0.0);
    for (std::size_t row = 0; row < table.size(); ++row) {
      if (table.number(row, "half_side") != half) continue;
      const auto number = [&](const char* name) { return table.number(row, name); };
      Sensors sensors;
      sensors.position = {{number("x"), number("y"), number("z")}};
      sensors.normal = {{number("nx"), number("ny"), number("nz")}};
      const auto result = illuminate(scene, sensors, {}, with_bounces(2.0, 2));
      worst.add(result.values.total_lux(0) / 10000.0 / number("ratio") - 1.0,
                table.text(row, "point"));
    }
    EXPECT_LE(worst.worst(), 0.02);
  }
}

TEST(ReflectedLight, AboveAWideLitPlaneIsItsReflectanceTimesTheSky) {
  TestScene scene;
  scene.materials[0] = testing_support::grey_material(0.4);
  scene.level({-2000, -2000, 2000, 2000}, 0.0);
  const auto source = testing_support::source_of(*testing_support::numbered_sky(16, 40, 180));
  Sensors sensors;
  sensors.position = {{0, 0, 5}, {0, 0, 5}};
  sensors.normal = {{0, 0, -1}, {1, 0, 0}};
  const auto result = illuminate(scene, sensors, source, with_bounces(1.0, 3));
  const double exitance = 0.4 * source.unobstructed_lux();
  WorstError worst("light of a wide plane, relative");
  worst.add(result.values.reflected_lux[0] / exitance - 1.0, "facing down");
  worst.add(result.values.reflected_lux[1] / exitance / 0.5 - 1.0, "upright");
  EXPECT_LE(worst.worst(), 0.01);
}

TEST(ReflectedLight, OfARoomIsThatOfRadiosity) {
  const ReferenceTable table(TENKU_TEST_REFERENCE "/illuminance/room.csv");
  const TestScene scene = testing_support::side_lit_room();
  const auto source = testing_support::source_of(*testing_support::numbered_sky(16, 40, 180));
  const double scale = source.unobstructed_lux() / 10000.0;
  const auto sensors_every = [&](std::size_t step) {
    Sensors sensors;
    for (std::size_t row = 0; row < table.size(); row += step) {
      sensors.position.push_back(
          {table.number(row, "x"), table.number(row, "y"), table.number(row, "z")});
      sensors.normal.push_back(kZenith);
    }
    return sensors;
  };
  WorstError direct_worst("room, direct, tolerance 1, percent");
  const Sensors all = sensors_every(1);
  const auto direct = illuminate(scene, all, source, with_bounces(1.0, 0));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double truth = scale * table.number(i, "direct_lux"), floor = 10.0 * scale;
    direct_worst.add(100.0 * (direct.values.total_lux(i) - truth) / std::max(truth, floor),
                     std::to_string(i));
  }
  EXPECT_LE(direct_worst.worst(), 1.0);
  constexpr std::size_t kStep = 17;
  const Sensors some = sensors_every(kStep);
  const auto total = illuminate(scene, some, source, with_bounces(2.0, 12));
  WorstError total_worst("room, total, tolerance 2, 12 bounces, percent");
  for (std::size_t i = 0; i < some.size(); ++i) {
    const double truth = scale * table.number(i * kStep, "total_lux");
    if (truth < 100.0 * scale) continue;  // daylight factor below 1 %
    total_worst.add(100.0 * (total.values.total_lux(i) / truth - 1.0), std::to_string(i * kStep));
  }
  EXPECT_LE(total_worst.worst(), 2.0);
}

}  // namespace
}  // namespace tenku
