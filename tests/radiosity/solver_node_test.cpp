// The solver with form factors that are given: models of one node a surface.
#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/progressive_refinement.h"
#include "radiosity/solver_scene.h"
#include "support/measured.h"
#include "support/reference_table.h"

namespace tenku {
namespace {

using testing_support::ReferenceTable;
using testing_support::SolverScene;
using testing_support::WorstError;

/// Triangles side by side along x, of the areas of the nodes; row i of the matrix belongs to the
/// one about x = 2 i.
class GivenFactors : public FormFactorMethod {
 public:
  std::vector<FormFactorRow> row;

  std::string_view name() const override { return "given"; }
  double lift_m() const override { return 0.0; }
  FormFactorRow from_point(Vec3 position, Vec3 normal) const override {
    if (normal.z < 0.0) return {};
    return row.at(static_cast<std::size_t>(std::lround(position.x / 2.0)));
  }
};

struct NodeModel {
  SolverScene scene;
  GivenFactors factors;
  std::vector<double> radiosity;
};

NodeModel model_at(const ReferenceTable& table, std::size_t first, std::size_t& end) {
  NodeModel model;
  ElementMesh& mesh = model.scene.mesh;
  for (end = first; end < table.size() && table.text(end, "model") == table.text(first, "model");) {
    const double x = 2.0 * table.number(end, "node"), side = 2.0 * table.number(end, "area");
    const auto v = static_cast<std::uint32_t>(mesh.vertices.size());
    // One metre wide, centred on x, of area side / 2; wall upright in y so that z is its normal.
    mesh.vertices.insert(mesh.vertices.end(), {{x - 0.5, 0, 0}, {x + 0.5, 0, 0}, {x, side, 0}});
    mesh.elements.push_back({v, v + 1, v + 2});
    mesh.object.push_back(0);
    mesh.material.push_back(
        model.scene.grey(table.number(end, "reflectance"), table.number(end, "emission")));
    mesh.patch_begin.push_back(static_cast<std::uint32_t>(mesh.size()));
    model.radiosity.push_back(table.number(end, "radiosity"));
    ++end;
  }
  for (std::size_t i = first; i < end; ++i) {
    model.factors.row.emplace_back();
    for (std::uint32_t j = 0; j < end - first; ++j) {
      const double f = table.number(i, "f" + std::to_string(j));
      if (f > 0.0) model.factors.row.back().push_back({2 * j, static_cast<float>(f)});
    }
  }
  return model;
}

TEST(ProgressiveRefinement, SolvesNodeModels) {
  const ReferenceTable table(TENKU_TEST_REFERENCE "/radiosity/node_models.csv");
  WorstError worst("node models, relative");
  for (std::size_t row = 0, end = 0; row < table.size(); row = end) {
    NodeModel model = model_at(table, row, end);
    const ElementMesh& mesh = model.scene.mesh;
    // Triangles in one plane see nothing of each other: what they see is given, so that the box
    // about the mesh must not tell that they face out of it.
    ElementMesh roomy = mesh;
    roomy.vertices.push_back({0, 0, 1});
    roomy.vertices.push_back({0.1, 0, 1});
    roomy.vertices.push_back({0, 0.1, 1});
    const auto v = static_cast<std::uint32_t>(roomy.vertices.size());
    roomy.elements.push_back({v - 3, v - 2, v - 1});
    roomy.object.push_back(0);
    roomy.material.push_back(model.scene.grey(0.0));
    roomy.patch_begin.push_back(static_cast<std::uint32_t>(roomy.size()));
    std::vector<Finding> findings;
    const SurfaceLight surfaces = surface_light(roomy, model.scene.materials, findings);
    PatchRows rows(roomy, model.factors, {});
    RefinementOptions options;
    options.tolerance = 1e-5;
    Progress quiet;
    const RefinementResult result = refine_progressively(
        roomy, surfaces, std::vector<Rgb>(roomy.sides()), rows, options, quiet);
    EXPECT_TRUE(result.is_converged);
    testing_support::expect_balanced(result.balance);
    for (std::size_t i = 0; i < model.radiosity.size(); ++i) {
      const double found = luminance_of(result.sides.radiosity[2 * i]);
      worst.add(found / model.radiosity[i] - 1.0, table.text(row, "model"));
    }
  }
  EXPECT_LE(worst.worst(), 0.0001);
}

/// Ball about the origin: the faces of a cube in n by n patches, blown up. What lies above `port_z`
/// is black.
SolverScene sphere(std::uint32_t n, double port_z, double reflectance) {
  SolverScene scene;
  const std::uint32_t wall = scene.grey(reflectance), port = scene.grey(0.0);
  const std::array<std::array<Vec3, 3>, 6> faces{{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                                  {{{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}}},
                                                  {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}},
                                                  {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}},
                                                  {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}},
                                                  {{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}}}};
  const auto along = [&](std::uint32_t i) { return std::tan(kPi / 4.0 * (2.0 * i / n - 1.0)); };
  for (const auto& [out, u, v] : faces) {
    for (std::uint32_t j = 0; j < n; ++j) {
      for (std::uint32_t i = 0; i < n; ++i) {
        const auto at = [&](std::uint32_t a, std::uint32_t b) {
          return normalized(out + along(a) * u + along(b) * v);
        };
        const std::array<Vec3, 4> corner{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
        const bool is_port =
            0.25 * (corner[0].z + corner[1].z + corner[2].z + corner[3].z) > port_z;
        scene.quad(corner, {1, 1}, is_port ? port : wall);
      }
    }
  }
  return scene;
}

TEST(ProgressiveRefinement, InAnIntegratingSphereIsTheClosedForm) {
  // E = rho Phi / (A (1 - rho (1 - port))), with the first flux all on the wall.
  for (const double port_z : {2.0, 0.9}) {
    const double rho = 0.9;
    const SolverScene scene = sphere(10, port_z, rho);
    std::vector<Finding> findings;
    const SurfaceLight surfaces = surface_light(scene.mesh, scene.materials, findings);
    double wall = 0.0, all = 0.0;
    for (std::size_t e = 0; e < scene.mesh.size(); ++e) {
      all += surfaces.area_m2[e];
      if (scene.mesh.material[e] == 0) wall += surfaces.area_m2[e];
    }
    std::vector<Rgb> direct(scene.mesh.sides());
    for (std::size_t e = 0; e < scene.mesh.size(); ++e) {
      // The side that faces the middle.
      const std::size_t inside =
          2 * e + (dot(scene.mesh.normal(2 * e), scene.mesh.centre(e)) < 0.0 ? 0 : 1);
      if (scene.mesh.material[e] == 0) direct[inside] = Rgb::grey(1000.0 / wall);
    }
    const auto method = form_factor_method("hemisphere-rays", scene.mesh, {.resolution = 64});
    PatchRows rows(scene.mesh, *method, {});
    RefinementOptions options;
    options.tolerance = 1e-4;
    Progress quiet;
    const RefinementResult result =
        refine_progressively(scene.mesh, surfaces, direct, rows, options, quiet);
    double mean = 0.0;
    for (std::size_t s = 0; s < scene.mesh.sides(); ++s) {
      mean += surfaces.area_m2[s / 2] * luminance_of(result.sides.received[s]) / all;
    }
    const double truth = rho * 1000.0 / (all * (1.0 - rho * wall / all));
    // Closed, flux is all there is to it; a port of flat facets is not quite one of a sphere.
    EXPECT_NEAR(mean, truth, (port_z > 1.0 ? 0.001 : 0.003) * truth) << port_z;
    EXPECT_LE(result.balance.escaped_lm, 1e-3);
  }
}

}  // namespace
}  // namespace tenku
