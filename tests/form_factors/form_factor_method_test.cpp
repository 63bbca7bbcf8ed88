// What every method of form factors promises.

#include <gtest/gtest.h>

#include <map>

#include "core/error.h"
#include "form_factor_mesh.h"
#include "form_factors/form_factor.h"
#include "support/generated_rooms.h"

namespace tenku {
namespace {

constexpr double kLift = 1e-5;

std::map<std::uint32_t, double> by_patch(const ElementMesh& mesh, const FormFactorRow& row) {
  std::map<std::uint32_t, double> sum;
  for (const auto& [side, value] : row) sum[mesh.object[side / 2]] += value;
  return sum;
}

class AllMethods : public testing::TestWithParam<std::string_view> {};

TEST_P(AllMethods, KnowsItsName) {
  const ElementMesh mesh = box_mesh({1, 1, 1}, 1);
  EXPECT_EQ(form_factor_method(GetParam(), mesh, {})->name(), GetParam());
}

TEST_P(AllMethods, RowsInAClosedBoxAddUpToOne) {
  const ElementMesh mesh = box_mesh({4, 3, 2.5}, 4);
  const auto method = form_factor_method(GetParam(), mesh, {});
  for (const std::size_t element : {0, 17, 70, 150}) {
    const Vec3 normal = mesh.normal(2 * element);
    double sum = 0.0;
    for (const auto& [side, value] :
         method->from_point(mesh.centre(element) + kLift * normal, normal)) {
      EXPECT_EQ(side % 2, 0U) << "a back of the box is not seen from inside";
      sum += value;
    }
    EXPECT_NEAR(sum, 1.0, 1e-3);
  }
}

TEST_P(AllMethods, ACubeFaceSeesTheOthersAlikeFromItsCentre) {
  // The opposite face is four squares with a corner on the axis (Howell's catalogue, B-3: 0.2395
  // in all); the side faces share the rest.
  const double x = 0.5;
  const double t = std::atan(x / std::sqrt(1 + x * x)) * x / std::sqrt(1 + x * x);
  const double opposite = 4.0 * (2.0 * t) / (2.0 * kPi);
  ElementMesh mesh = box_mesh({1, 1, 1}, 2);
  for (std::size_t e = 0; e < mesh.size(); ++e) mesh.object[e] = static_cast<std::uint32_t>(e / 8);
  const auto sum = by_patch(
      mesh, form_factor_method(GetParam(), mesh, {})->from_point({0.5, 0.5, kLift}, kZenith));
  EXPECT_NEAR(sum.at(1), opposite, 0.003);
  for (const std::uint32_t face : {2U, 3U, 4U, 5U}) {
    EXPECT_NEAR(sum.at(face), (1.0 - opposite) / 4.0, 0.003);
  }
}

/// A square of side `2 half` about (x, y, z), its normal along z.
std::vector<Vec3> level_square(Vec3 centre, double half) {
  return {centre + Vec3{-half, -half, 0}, centre + Vec3{half, -half, 0},
          centre + Vec3{half, half, 0}, centre + Vec3{-half, half, 0}};
}

/// From a level surface to a level square over it, the centre of which is on the axis: Howell's
/// catalogue, B-3, four times.
double square_on_axis(double half, double height) {
  const double x = half / height, r = std::sqrt(1.0 + x * x);
  return 4.0 / kPi * x / r * std::atan(x / r);
}

double total(const FormFactorRow& row) {
  double sum = 0.0;
  for (const FormFactor& f : row) sum += f.value;
  return sum;
}

TEST_P(AllMethods, AnElementRoundThePoleIsMeasured) {
  ElementMesh mesh;
  add_polygon(mesh, level_square({0.1, 0.05, 0.3}, 1.0));
  add_polygon(mesh, level_square({0, 0, 0.3}, 0.5));
  mesh.patch_begin = {0, 2, 4};
  ElementMesh only = mesh;
  only.elements.erase(only.elements.begin(), only.elements.begin() + 2);
  const auto method = form_factor_method(GetParam(), only, {.resolution = 512});
  EXPECT_NEAR(total(method->from_point({0, 0, 0}, kZenith)), square_on_axis(0.5, 0.3), 0.002);
}

TEST_P(AllMethods, WhatIsSeenEdgeOnOrBelowTheHorizonCoversNothing) {
  ElementMesh mesh;
  add_polygon(mesh, {{1, 0, 1}, {2, 0, 1}, {2, 0, 2}, {1, 0, 2}});  // its plane holds the point
  add_polygon(mesh, level_square({0, 0, -1}, 5.0));
  add_polygon(mesh, level_square({4, 0, 0}, 1.0));  // lies in the horizon
  const auto method = form_factor_method(GetParam(), mesh, {});
  EXPECT_LT(total(method->from_point({0, 0, 0}, kZenith)), 1e-9);
}

TEST_P(AllMethods, AWallAcrossTheHorizonCountsAboveItOnly) {
  // Half of the hemisphere is behind an endless wall, of any side of it: 1/2 (1 - cos) with the
  // wall at a right angle, 0.5. This one is 2000 m wide at 1 m.
  ElementMesh mesh;
  add_polygon(mesh, {{1, -1000, -1000}, {1, 1000, -1000}, {1, 1000, 1000}, {1, -1000, 1000}});
  const auto method = form_factor_method(GetParam(), mesh, {});
  EXPECT_NEAR(total(method->from_point({0, 0, 0}, kZenith)), 0.5, 0.003);
}

TEST_P(AllMethods, WhatStandsBeforeHides) {
  // A square at a third of the height, a third as wide, hides the larger one exactly; half as wide
  // as that leaves the rest.
  ElementMesh mesh;
  add_polygon(mesh, level_square({0, 0, 3}, 1.5));
  add_polygon(mesh, level_square({0, 0, 1}, 0.25));
  const auto row =
      form_factor_method(GetParam(), mesh, {.resolution = 512})->from_point({0, 0, 0}, kZenith);
  const auto sum = by_patch(mesh, row);
  const double small = square_on_axis(0.25, 1.0);
  EXPECT_NEAR(sum.at(1), small, 0.002);
  EXPECT_NEAR(sum.at(0), square_on_axis(1.5, 3.0) - small, 0.002);
}

TEST_P(AllMethods, SidesAreTold) {
  ElementMesh mesh;
  add_polygon(mesh, level_square({0, 0, 1}, 1.0));   // its back is below
  add_polygon(mesh, level_square({0, 0, -1}, 1.0));  // its front is above
  const auto method = form_factor_method(GetParam(), mesh, {});
  for (const FormFactor& f : method->from_point({0, 0, 0}, kZenith)) EXPECT_EQ(f.side % 2, 1U);
  for (const FormFactor& f : method->from_point({0, 0, 0}, -kZenith)) EXPECT_EQ(f.side % 2, 0U);
}

TEST_P(AllMethods, PlanesThatCrossAreCutWhereTheyDo) {
  // Two squares over the point slope to opposite sides and cross over it: each is the nearer one
  // in half of the directions.
  ElementMesh mesh;
  add_polygon(mesh, {{-1, -1, 0.8}, {1, -1, 1.2}, {1, 1, 1.2}, {-1, 1, 0.8}});
  add_polygon(mesh, {{-1, -1, 1.2}, {1, -1, 0.8}, {1, 1, 0.8}, {-1, 1, 1.2}});
  const auto sum = by_patch(
      mesh,
      form_factor_method(GetParam(), mesh, {.resolution = 512})->from_point({0, 0, 0}, kZenith));
  EXPECT_NEAR(sum.at(0), sum.at(1), 0.003);
  EXPECT_GT(sum.at(0) + sum.at(1), square_on_axis(1.0, 1.2));
  EXPECT_LT(sum.at(0) + sum.at(1), square_on_axis(1.0, 0.8));
}

/// Root of the sum over fronts of some elements of the squares of what rows are wrong by.
double error_of(const FormFactorMethod& method, const ElementMesh& mesh, std::size_t step) {
  const auto exact = form_factor_method("analytic", mesh, {});
  double sum = 0.0;
  for (std::size_t element = 0; element < mesh.size(); element += step) {
    const Vec3 normal = mesh.normal(2 * element);
    const Vec3 at = mesh.centre(element) + kLift * normal;
    std::map<std::uint32_t, double> difference;
    for (const auto& [side, value] : exact->from_point(at, normal)) difference[side] -= value;
    for (const auto& [side, value] : method.from_point(at, normal)) difference[side] += value;
    for (const auto& [side, value] : difference) sum += value * value;
  }
  return std::sqrt(sum);
}

TEST_P(AllMethods, ErrorFallsWithTheResolution) {
  // The orders that docs/form_factors.md states, less what chance takes and gives: over a factor of
  // eight in the resolution, where furniture hides parts of walls.
  const ElementMesh mesh = testing_support::furnished_room({1.05, 0.95});
  const auto error_at = [&](int resolution) {
    return error_of(*form_factor_method(GetParam(), mesh, {.resolution = resolution}), mesh, 19);
  };
  if (GetParam() == "analytic") {
    EXPECT_LT(error_at(32), 1e-9);
    return;
  }
  const double order = std::log(error_at(32) / error_at(256)) / std::log(8.0);
  EXPECT_GT(order, GetParam() == "hemicube" || GetParam() == "hemisphere-zbuffer" ? 1.1 : 1.3);
}

TEST(HemisphereScanline, IsExactWhereNothingIsHidden) {
  const ElementMesh mesh = box_mesh({4, 3, 2.5}, 3);
  const auto method = form_factor_method("hemisphere-scanline", mesh, {.resolution = 8});
  EXPECT_LT(error_of(*method, mesh, 5), 1e-6);
}

TEST(HemisphereScanline, MeetsSheetsBetweenLinesAsOftenAsTheyCount) {
  // A small square in the open, a tenth as high as lines are apart: the mean over many points is
  // that of Lambert's law for a small surface, cos cos' A / (pi r^2).
  constexpr double kHalf = 0.01;
  ElementMesh mesh;
  add_polygon(mesh, level_square({0, 0, 1}, 5.0));
  add_polygon(mesh, level_square({0, 0, 0.8}, kHalf));
  mesh.object[2] = mesh.object[3] = 1;
  const auto method = form_factor_method("hemisphere-scanline", mesh, {.resolution = 8});
  double sum = 0.0, expected = 0.0;
  constexpr int kPoints = 40000;
  for (int k = 0; k < kPoints; ++k) {
    const double x = 0.4 * k / kPoints, square = x * x + 0.64;
    for (const FormFactor& f : method->from_point({x, 0, 0}, kZenith)) {
      if (f.side / 2 >= 2) sum += f.value;
    }
    expected += 0.64 * 4.0 * kHalf * kHalf / (kPi * square * square);
  }
  EXPECT_NEAR(sum / expected, 1.0, 0.05);  // one in ten is met: 0.3 / sqrt(4000), ten times that
}

INSTANTIATE_TEST_SUITE_P(FormFactors, AllMethods, testing::ValuesIn(form_factor_method_names()),
                         [](const auto& test) {
                           std::string name(test.param);
                           std::erase(name, '-');
                           return name;
                         });

TEST(FormFactorMethodName, IsSuggestedWhereItIsMistyped) {
  const ElementMesh mesh = box_mesh({1, 1, 1}, 1);
  try {
    form_factor_method("hemisphere-ray", mesh, {});
    FAIL() << "no such method";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'hemisphere-rays'"), std::string::npos);
  }
}

TEST(FormFactorMethodOptions, OutOfRangeAreRefused) {
  const ElementMesh mesh = box_mesh({1, 1, 1}, 1);
  EXPECT_THROW(form_factor_method("hemisphere-rays", mesh, {.resolution = 0}), InputError);
  EXPECT_THROW(form_factor_method("hemisphere-rays", mesh, {.polyline_deg = -1.0}), InputError);
}

}  // namespace
}  // namespace tenku
