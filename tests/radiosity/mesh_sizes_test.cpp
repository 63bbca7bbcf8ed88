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
      : LitSquare(mesh_of(side, element_m), lux) {}

  LitSquare(ElementMesh elements, const std::function<double(Vec3)>& lux)
      : mesh(std::move(elements)), points(side_points(mesh)), light{mesh, points, {}, {},
                                                                    {},   {},     {}} {
    for (std::size_t i = 0; i < points.size(); ++i) {
      light.lux.push_back(lux(points.sensors.position[i]));
      light.is_lit.push_back(points.sensors.normal[i].z > 0.0);
    }
    light.variance.assign(points.size(), 0.0);
    light.direct_variance = light.variance;
    for (std::size_t s = 0; s < mesh.sides(); ++s) {
      light.middle_off.push_back(std::abs(lux(mesh.centre(s / 2)) - side_lux(light, s)));
    }
  }

  static ElementMesh mesh_of(double side, double element_m) {
    Surface surface;
    surface.level(0, 0, side, side);
    return surface.mesh(element_m);
  }
};

/// Squares of 0.1 m in two triangles each, so many by so many.
ElementMesh halved_squares(std::uint32_t count) {
  ElementMesh mesh;
  for (std::uint32_t y = 0; y <= count; ++y) {
    for (std::uint32_t x = 0; x <= count; ++x) mesh.vertices.push_back({0.1 * x, 0.1 * y, 0.0});
  }
  for (std::uint32_t y = 0; y < count; ++y) {
    for (std::uint32_t x = 0; x < count; ++x) {
      const std::uint32_t a = y * (count + 1) + x, b = a + count + 1;
      mesh.elements.push_back({a, a + 1, b + 1});
      mesh.elements.push_back({a, b + 1, b});
    }
  }
  mesh.material.assign(mesh.size(), 0);
  mesh.object.assign(mesh.size(), 0);
  mesh.patch_begin = {0, static_cast<std::uint32_t>(mesh.size())};
  return mesh;
}

/// Two triangles on the unit square, values at its corners.
struct TwoTriangles {
  ElementMesh mesh;
  SidePoints points;
  LightOnMesh light;

  explicit TwoTriangles(const std::array<double, 4>& lux)
      : mesh(unit_square()), points(side_points(mesh)), light{mesh, points, {}, {}, {}, {}, {}} {
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

TEST(MeshSizes, FindInWhichElementsTheEdgeOfAShadowLies) {
  const double edge = 1.03;
  const LitSquare jump(2.0, 0.1, [&](Vec3 p) { return p.x > edge ? 1.0 : 0.0; });
  const auto error = interpolation_error(jump.light);
  double crossed = 0.0, all = 0.0;
  for (std::size_t s = 0; s < jump.mesh.sides(); ++s) {
    if (jump.light.is_lit[jump.points.corner[s][0]] == 0) continue;
    bool is_left = false, is_right = false;
    for (const std::uint32_t v : jump.mesh.elements[s / 2]) {
      (jump.mesh.vertices[v].x > edge ? is_right : is_left) = true;
    }
    const double square = jump.mesh.area_m2(s / 2) * error[s].lux * error[s].lux;
    all += square;
    if (is_left && is_right) crossed += square;
  }
  EXPECT_GT(crossed / all, 0.8);
}

TEST(MeshSizes, FindAShadowThatNoCornerLiesIn) {
  const LitSquare square(2.0, 0.5, [](Vec3) { return 1.0; });
  LightOnMesh light = square.light;
  const std::size_t dark = 2 * (square.mesh.size() / 2);  // the front of an element
  light.middle_off[dark] = 1.0;
  const auto error = interpolation_error(light);
  for (std::size_t s = 0; s < error.size(); ++s) {
    EXPECT_NEAR(error[s].lux, s == dark ? 0.7 : 0.0, 1e-12);
  }
}

TEST(MeshSizes, AskNothingOfEdgesThatFollowTheEdgeOfAShadow) {
  // Light that bends along x = 1, where edges of elements are.
  const LitSquare square(halved_squares(20), [](Vec3 p) { return std::max(0.0, p.x - 1.0); });
  std::vector<std::uint8_t> is_bent(square.mesh.size());
  std::size_t along = 0;
  for (std::size_t e = 0; e < square.mesh.size(); ++e) {
    const auto is_on = [&](unsigned k) {
      return std::abs(square.mesh.vertices[square.mesh.elements[e][k % 3]].x - 1.0) < 1e-9;
    };
    for (unsigned k = 0; k < 3; ++k) {
      if (is_on(k) && is_on(k + 1)) is_bent[e] |= static_cast<std::uint8_t>(1U << k), ++along;
    }
  }
  ASSERT_EQ(along, 40U);
  EXPECT_GT(interpolation_rms(square.light, interpolation_error(square.light)), 1e-3);
  const auto error = interpolation_error(square.light, is_bent);
  // Corners are drawn back from the outline, which bends what is drawn there a little.
  EXPECT_LT(interpolation_rms(square.light, error), 2e-4);
  const ErrorSizes asked{.allowed_lux = 1.0, .range = {1e-3, 10.0}};
  const std::vector<double> size = sizes_by_error(square.light, error, asked, is_bent);
  for (std::size_t e = 0; e < size.size(); ++e) {
    const bool is_along = is_bent[e] != 0;  // it would lose the line
    EXPECT_LT(size[e], is_along ? 0.13 : 10.0);
    EXPECT_GT(size[e], is_along ? 0.05 : 0.3);
  }
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
    if (i % 2 == 0) sum += error[i].size_m;
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
  double elements = 0.0;
  for (std::size_t e = 0; e < sizes.size(); ++e) {
    elements += square.mesh.area_m2(e) / (std::sqrt(3.0) / 4.0 * sizes[e] * sizes[e]);
  }
  EXPECT_NEAR(elements, 500.0, 25.0);
  EXPECT_LT(sizes[0], 0.3 * sizes[sizes.size() / 2]);  // fine at the origin
}

}  // namespace
}  // namespace tenku
