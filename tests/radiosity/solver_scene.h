/// Rooms for the solver, divided by hand.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "meshing/element_mesh.h"
#include "radiosity/interior.h"
#include "scene/material.h"

namespace tenku::testing_support {

/// Rectangles of patches of two elements each.
class SolverScene {
 public:
  ElementMesh mesh;
  std::vector<Material> materials;

  std::uint32_t material(Rgb reflectance, Rgb emission = {}) {
    Material m;
    m.reflectance = reflectance;
    m.emission_lm_m2 = emission;
    materials.push_back(m);
    return static_cast<std::uint32_t>(materials.size() - 1);
  }
  std::uint32_t grey(double reflectance, double emission = 0.0) {
    return material(Rgb::grey(reflectance), Rgb::grey(emission));
  }

  /// Parallelogram a, b, c, d in n x m patches; the front is where it runs counter-clockwise.
  void quad(std::array<Vec3, 4> corner, std::array<std::uint32_t, 2> cells,
            std::uint32_t material) {
    const auto [n, m] = cells;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const Vec3 a = corner[0], along = corner[1] - corner[0], up = corner[3] - corner[0];
    const Vec3 bent = corner[2] - corner[1] - up;  // of a quadrilateral that is no parallelogram
    for (std::uint32_t j = 0; j <= m; ++j) {
      for (std::uint32_t i = 0; i <= n; ++i) {
        const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / m;
        mesh.vertices.push_back(a + u * along + v * up + u * v * bent);
      }
    }
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return first + j * (n + 1) + i; };
    for (std::uint32_t j = 0; j < m; ++j) {
      for (std::uint32_t i = 0; i < n; ++i) {
        mesh.elements.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        mesh.elements.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        mesh.patch_begin.push_back(static_cast<std::uint32_t>(mesh.size()));
      }
    }
    mesh.material.resize(mesh.size(), material);
    mesh.object.resize(mesh.size(), 0);
  }

  /// Closed room from the origin, its insides the fronts: floor, ceiling, x = 0, x = W, y = 0,
  /// y = D; about `per_m` patches a metre.
  void room(Vec3 size, std::array<std::uint32_t, 6> material, double per_m) {
    const auto [w, d, h] = size;
    const auto cells = [&](double a, double b) {
      const auto count = [&](double x) {
        return static_cast<std::uint32_t>(std::max(1.0, std::round(per_m * x)));
      };
      return std::array<std::uint32_t, 2>{count(a), count(b)};
    };
    quad({{{0, 0, 0}, {w, 0, 0}, {w, d, 0}, {0, d, 0}}}, cells(w, d), material[0]);
    quad({{{0, 0, h}, {0, d, h}, {w, d, h}, {w, 0, h}}}, cells(d, w), material[1]);
    quad({{{0, 0, 0}, {0, d, 0}, {0, d, h}, {0, 0, h}}}, cells(d, h), material[2]);
    quad({{{w, 0, 0}, {w, 0, h}, {w, d, h}, {w, d, 0}}}, cells(h, d), material[3]);
    quad({{{0, 0, 0}, {0, 0, h}, {w, 0, h}, {w, 0, 0}}}, cells(h, w), material[4]);
    quad({{{0, d, 0}, {w, d, 0}, {w, d, h}, {0, d, h}}}, cells(w, h), material[5]);
  }

  InteriorLight light(const InteriorOptions& options = {}) const {
    Progress quiet;
    return Interior(mesh, materials, options).light({}, quiet);
  }
};

/// emitted = absorbed + escaped + unshot.
inline void expect_balanced(const LightBalance& b, double share = 1e-6) {
  EXPECT_NEAR(b.absorbed_lm + b.escaped_lm + b.unshot_lm, b.emitted_lm, share * b.emitted_lm);
}

}  // namespace tenku::testing_support
