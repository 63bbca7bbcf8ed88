// What every method of form factors promises.

#include <gtest/gtest.h>

#include <map>

#include "core/error.h"
#include "form_factor_mesh.h"
#include "radiosity/form_factor.h"

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
  EXPECT_THROW(form_factor_method("hemisphere-rays", mesh, {.polyline_deg = 0.0}), InputError);
}

}  // namespace
}  // namespace tenku
