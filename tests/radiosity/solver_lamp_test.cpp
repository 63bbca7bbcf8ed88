// Light of lamps and of lit patches, and the Cornell box.
#include <gtest/gtest.h>

#include <vector>

#include "form_factors/contour_factor.h"
#include "radiosity/solver_scene.h"
#include "support/measured.h"
#include "support/reference_table.h"

namespace tenku {
namespace {

using testing_support::ReferenceTable;
using testing_support::SolverScene;
using testing_support::WorstError;

Vec3 vector_of(const ReferenceTable& table, std::size_t row, const std::string& prefix) {
  return {table.number(row, prefix + "x"), table.number(row, prefix + "y"),
          table.number(row, prefix + "z")};
}

/// A patch that shines, of CIE 171 5.6: level, about (2, 2).
void add_patch(SolverScene& scene, double half, double z, std::uint32_t cells) {
  const std::uint32_t lamp = scene.grey(0.0, 1.0);
  const double a = 2.0 - half, b = 2.0 + half;
  scene.quad({{{a, a, z}, {b, a, z}, {b, b, z}, {a, b, z}}}, {cells, cells}, lamp);
}

SolverScene cie_171(const std::string& name) {
  SolverScene scene;
  if (name.starts_with("5.3")) add_patch(scene, 0.5, 3.0, 2);
  if (name == "5.6_S2_0.5x0.5") add_patch(scene, 0.25, 0.0, 1);
  if (name == "5.6_S2_4x4") add_patch(scene, 2.0, 0.0, 4);
  if (name == "5.6_S2_500x500") add_patch(scene, 250.0, 0.0, 4);
  if (name.starts_with("5.7")) {
    const std::uint32_t lamp = scene.grey(0.0, 1.0), black = scene.grey(0.0);
    scene.quad({{{0, 4, 0}, {4, 4, 0}, {4, 4, 3}, {0, 4, 3}}}, {4, 3}, lamp);
    for (const double y : {2.5, 2.7}) {
      scene.quad({{{0, y, 0}, {4, y, 0}, {4, y, 1}, {0, y, 1}}}, {2, 1}, black);
    }
    scene.quad({{{0, 2.5, 1}, {4, 2.5, 1}, {4, 2.7, 1}, {0, 2.7, 1}}}, {2, 1}, black);
  }
  return scene;
}

TEST(RadiosityOfLamps, IsThatOfCie171) {
  const ReferenceTable table(TENKU_TEST_REFERENCE "/radiosity/cie_171_reflection.csv");
  for (std::size_t row = 0, end = 0; row < table.size(); row = end) {
    const std::string name = table.text(row, "case");
    Sensors sensors;
    for (; end < table.size() && table.text(end, "case") == name; ++end) {
      sensors.position.push_back(vector_of(table, end, ""));
      sensors.normal.push_back(vector_of(table, end, "n"));
    }
    const SolverScene scene = cie_171(name);
    Progress quiet;
    Interior interior(scene.mesh, scene.materials, {});
    const InteriorLight light = interior.light({}, quiet);
    SensorIlluminance values(sensors.size());
    InteriorSensors look = interior.look_from(sensors);
    interior.add_reflected(look, light, values, quiet);
    WorstError worst("CIE 171 " + name + ", relative");
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      const double truth = table.number(row + i, "ratio");
      if (truth > 0.0) worst.add(values.reflected_lux[i] / truth - 1.0, std::to_string(i));
      EXPECT_LE(std::abs(values.reflected_lux[i] - truth), values.error_lux[i] + 1e-4 * truth)
          << name << " " << i << " " << values.reflected_lux[i] << " " << truth;
    }
    EXPECT_LE(worst.worst(), 0.02) << name;
  }
}

constexpr double kPerMetre = 100.0;  // units of the box in ours, so that lengths are usual ones

SolverScene cornell_box(bool with_blocks, double cell) {
  const ReferenceTable table(TENKU_TEST_REFERENCE "/radiosity/cornell_box.csv");
  SolverScene scene;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const std::string name = table.text(row, "name");
    const bool of_block = name.starts_with("short") || name.starts_with("tall");
    if (of_block && !with_blocks) continue;
    const bool emits = table.number(row, "emits") > 0.0;
    const Rgb rho{table.number(row, "rho_r"), table.number(row, "rho_g"),
                  table.number(row, "rho_b")};
    const std::uint32_t material =
        scene.material(rho, emits ? Rgb{17.0 * kPi, 12.0 * kPi, 4.0 * kPi} : Rgb{});
    std::array<Vec3, 4> corner;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::string number = std::to_string(k);
      corner[k] =
          (1.0 / kPerMetre) * Vec3{table.number(row, "x" + number), table.number(row, "y" + number),
                                   table.number(row, "z" + number)};
    }
    const auto cells = [&](Vec3 edge) {
      return static_cast<std::uint32_t>(std::max(1.0, std::round(length(edge) / cell)));
    };
    // The reference has the lamp below the ceiling, with a dark back.
    if (emits) {
      for (Vec3& c : corner) c.y = 5.483;
      std::array<Vec3, 4> shield = corner;
      for (Vec3& c : shield) c.y = 5.4845;
      scene.quad(shield, {1, 1}, scene.grey(0.0));
    }
    scene.quad(corner, {cells(corner[1] - corner[0]), cells(corner[3] - corner[0])}, material);
  }
  return scene;
}

TEST(RadiosityOfLamps, InTheCornellBoxIsThatOfPathTracing) {
  const ReferenceTable table(TENKU_TEST_REFERENCE "/radiosity/cornell_irradiance.csv");
  for (const bool with_blocks : {false, true}) {
    const std::string name = with_blocks ? "with_blocks" : "empty_box_no_blocks";
    const SolverScene scene = cornell_box(with_blocks, 0.4);
    Progress quiet;
    Interior interior(scene.mesh, scene.materials, {});
    const InteriorLight light = interior.light({}, quiet);
    testing_support::expect_balanced(light.shots.balance);
    Sensors sensors;
    std::vector<Rgb> truth, sigma;
    const auto rgb = [&](std::size_t row, const std::string& prefix) {
      return Rgb{table.number(row, prefix + "R"), table.number(row, prefix + "G"),
                 table.number(row, prefix + "B")};
    };
    for (std::size_t row = 0; row < table.size(); ++row) {
      if (table.text(row, "scene") != name) continue;
      sensors.position.push_back((1.0 / kPerMetre) * vector_of(table, row, ""));
      sensors.normal.push_back(vector_of(table, row, "n"));
      truth.push_back(rgb(row, "E_"));
      sigma.push_back(rgb(row, "stderr_"));
    }
    SensorIlluminance values(sensors.size());
    InteriorSensors look = interior.look_from(sensors);
    interior.add_reflected(look, light, values, quiet);
    WorstError worst("Cornell box, " + name + ", beyond 3 sigma, relative");
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      const double expected = luminance_of(truth[i]), noise = 3.0 * luminance_of(sigma[i]);
      const double error = std::abs(values.reflected_lux[i] - expected);
      EXPECT_LE(error, values.error_lux[i] + noise) << name << " " << i;
      worst.add(std::max(0.0, error - noise) / expected, std::to_string(i));
    }
    EXPECT_LE(worst.worst(), 0.005);
  }
}

}  // namespace
}  // namespace tenku
