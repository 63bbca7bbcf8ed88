// Sizes of elements: the equations of the source by hand, interpolation errors in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "meshing/mesh_checks.h"
#include "radiosity/sizes_by_change.h"
#include "radiosity/sizes_by_error.h"
#include "support/measured.h"

namespace tenku {
namespace {

using testing_support::Surface;

/// Light on a square of side `side`, both faces of it or only the front.
struct LitSquare {
  ElementMesh mesh;
  SidePoints points;
  LightOnMesh light;

  LitSquare(double side, double element_m, const std::function<double(Vec3)>& lux)
      : mesh(mesh_of(side, element_m)), points(side_points(mesh)), light{mesh, points, {}, {}, {}} {
    for (std::size_t i = 0; i < points.size(); ++i) {
      light.lux.push_back(lux(points.sensors.position[i]));
      light.is_lit.push_back(points.sensors.normal[i].z > 0.0);
    }
    light.variance.assign(points.size(), 0.0);
  }

  static ElementMesh mesh_of(double side, double element_m) {
    Surface surface;
    surface.level(0, 0, side, side);
    return surface.mesh(element_m);
  }
};

/// Two triangles on the unit square, values at its corners.
struct TwoTriangles {
  ElementMesh mesh;
  SidePoints points;
  LightOnMesh light;

  explicit TwoTriangles(const std::array<double, 4>& lux)
      : mesh(unit_square()), points(side_points(mesh)), light{mesh, points, {}, {}, {}} {
    light.lux.resize(points.size());
    for (std::size_t s = 0; s < mesh.sides(); ++s) {
      for (unsigned k = 0; k < 3; ++k) {
        light.lux[points.corner[s][k]] = lux.at(mesh.elements[s / 2][k]);
      }
    }
    light.is_lit.assign(points.size(), 1);
    light.variance.assign(points.size(), 0.0);
  }

  static ElementMesh unit_square() {
    ElementMesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.elements = {{0, 1, 2}, {0, 2, 3}};
    mesh.material = mesh.object = {0, 0};
    mesh.patch_begin = {0, 2};
    return mesh;
  }
  double at(const std::vector<double>& of_point, std::uint32_t vertex) const {
    for (std::size_t s = 0; s < mesh.sides(); ++s) {
      for (unsigned k = 0; k < 3; ++k) {
        if (mesh.elements[s / 2][k] == vertex) return of_point[points.corner[s][k]];
      }
    }
    return -1.0;
  }
};

TEST(MeshSizes, OfTheSourceAreThoseFoundByHand) {
  const TwoTriangles square({0.0, 10.0, 20.0, 40.0});
  const std::vector<double> change = change_per_metre(square.light);
  const double root = std::numbers::sqrt2;
  EXPECT_NEAR(square.at(change, 0), (10.0 + 20.0 / root + 40.0) / 3.0, 1e-12);  // eq. 1
  EXPECT_NEAR(square.at(change, 1), (10.0 + 10.0) / 2.0, 1e-12);
  EXPECT_NEAR(square.at(change, 2), (20.0 / root + 10.0 + 20.0) / 3.0, 1e-12);
  EXPECT_NEAR(square.at(change, 3), (40.0 + 20.0) / 2.0, 1e-12);
  const std::vector<double> size = sizes_by_change(square.light, {0.1, 0.9});
  EXPECT_NEAR(size[1], 0.9, 1e-12);  // eq. 2: the least dI
  EXPECT_NEAR(size[3], 0.1, 1e-12);  // eq. 3: the greatest
  EXPECT_NEAR(size[0], 0.9 - 0.8 * (square.at(change, 0) - 10.0) / 20.0, 1e-12);  // eqs. 5 to 7
}

TEST(MeshSizes, AreTheLargestWhereLightDoesNotChange) {
  const TwoTriangles square({7.0, 7.0, 7.0, 7.0});
  for (const double size : sizes_by_change(square.light, {0.1, 0.9})) EXPECT_EQ(size, 0.9);
}

TEST(MeshSizes, KnowWhatInterpolationMisses) {
  // What lines between corners miss of x^2 in right triangles with legs h: the integral of
  // (x^2 - h x)^2 is h^6 / 60 by Euler's beta function, the mean square h^4 / 30.
  const double leg = 0.1;
  const LitSquare square(2.0, leg * std::numbers::sqrt2, [](Vec3 p) { return p.x * p.x; });
  const double found = interpolation_rms(square.light, interpolation_error(square.light));
  const double truth = leg * leg / std::sqrt(30.0);
  testing_support::WorstError worst("estimate of the interpolation error of a parabola, relative");
  worst.add(found / truth - 1.0, "x^2");
  EXPECT_LE(worst.worst(), 0.3);  // the shape of triangles is not looked at
}

TEST(MeshSizes, TellJumpsFromSmoothLight) {
  const auto wave = [](Vec3 p) { return std::sin(3.0 * p.x); };
  const LitSquare smooth(2.0, 0.1, wave);
  // By the squared error: where a wave does not bend, hardly any is left to have an order.
  double sum = 0.0, all = 0.0;
  for (const InterpolationError& e : interpolation_error(smooth.light)) {
    sum += e.lux * e.lux * e.order;
    all += e.lux * e.lux;
  }
  EXPECT_GT(sum / all, 1.8);
  const LitSquare jump(2.0, 0.1, [](Vec3 p) { return p.x > 1.01 ? 1.0 : 0.0; });
  double least = 2.0;
  for (const InterpolationError& e : interpolation_error(jump.light)) {
    if (e.lux > 0.05) least = std::min(least, e.order);
  }
  EXPECT_LT(least, 0.5);
}

/// What an adaptive mesh of elements of these sizes would have, by the formula for a parabola.
TEST(MeshSizes, ForAnErrorAreAsFineAsItTakes) {
  const LitSquare square(2.0, 0.1, [](Vec3 p) { return p.x * p.x + p.y * p.y; });
  const auto error = interpolation_error(square.light);
  const double now = interpolation_rms(square.light, error);
  const std::vector<double> half =
      sizes_by_error(square.light, error, {.allowed_lux = now / 4.0, .range = {1e-3, 10.0}});
  const std::vector<double> twice =
      sizes_by_error(square.light, error, {.allowed_lux = 4.0 * now, .range = {1e-3, 10.0}});
  double sum_half = 0.0, sum_twice = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    if (square.light.is_lit[i] == 0) continue;
    sum += error[i].size_m;
  }
  for (const double s : half) sum_half += s;
  for (const double s : twice) sum_twice += s;
  // The error falls with the square of the size.
  EXPECT_NEAR(sum_half / sum, 0.5, 0.05);
  EXPECT_NEAR(sum_twice / sum, 2.0, 0.2);
}

TEST(MeshSizes, ForANumberOfElementsGiveSoMany) {
  const LitSquare square(2.0, 0.1, [](Vec3 p) { return std::exp(-20.0 * (p.x + p.y)); });
  const auto sizes = sizes_by_error(square.light, interpolation_error(square.light),
                                    {.elements_max = 500, .range = {1e-3, 10.0}});
  const std::vector<std::uint32_t> vertex = vertices_of(square.light);
  double elements = 0.0;
  for (std::size_t s = 0; s < square.mesh.sides(); s += 2) {
    for (const std::uint32_t i : square.points.corner[s]) {
      const double size = sizes[vertex[i]];
      elements += square.mesh.area_m2(s / 2) / 3.0 / (std::sqrt(3.0) / 4.0 * size * size);
    }
  }
  EXPECT_NEAR(elements, 500.0, 25.0);
  EXPECT_LT(sizes[0], 0.3 * sizes[sizes.size() / 2]);  // fine at the origin
}

}  // namespace
}  // namespace tenku
