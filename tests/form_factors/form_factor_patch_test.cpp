// Rows of surfaces, and matrices of groups.

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "form_factor_mesh.h"
#include "form_factors/group_form_factors.h"

namespace tenku {
namespace {

/// Each element a patch of its own.
ElementMesh one_by_one(ElementMesh mesh) {
  mesh.patch_begin.clear();
  for (std::uint32_t e = 0; e <= mesh.size(); ++e) mesh.patch_begin.push_back(e);
  return mesh;
}

/// A closed box with a smaller one hanging in it: twelve groups, each sees no other whole.
ElementMesh box_in_box() {
  ElementMesh mesh = box_mesh({4, 3, 2.5}, 1);
  ElementMesh inner = box_mesh({1.2, 0.8, 0.6}, 1);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3& v : inner.vertices) mesh.vertices.push_back(v + Vec3{1.1, 0.9, 0.7});
  for (std::size_t e = 0; e < inner.size(); ++e) {
    const auto [a, b, c] = inner.elements[e];
    mesh.elements.push_back({first + a, first + c, first + b});  // fronts outward
    mesh.material.push_back(0);
    mesh.object.push_back(6 + inner.object[e]);
  }
  return one_by_one(std::move(mesh));
}

class GroupMatrix : public testing::TestWithParam<std::string_view> {};

TEST_P(GroupMatrix, OfAClosedSceneHasRowsOfOneAndIsReciprocal) {
  const ElementMesh mesh = box_in_box();
  const auto method = form_factor_method(GetParam(), mesh, {.resolution = 64});
  Progress progress;
  const GroupFormFactors matrix =
      group_form_factors(*method, mesh, 12, {.patch = {.most_points = 100}}, progress);
  for (std::size_t from = 0; from < 12; ++from) EXPECT_NEAR(matrix.row_sum(from), 1.0, 0.005);
  EXPECT_LT(matrix.reciprocity_defect(), 0.02);
  EXPECT_NEAR(matrix.area_m2[0], 12.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Methods, GroupMatrix, testing::ValuesIn(form_factor_method_names()),
                         [](const auto& test) {
                           std::string name(test.param);
                           std::erase(name, '-');
                           return name;
                         });

TEST(GroupMatrix, OfTwoSidesDoesNotDependOnWhichWayFacesLook) {
  // Opposite squares at their own distance: 0.199 824 896 (Howell C-11), whichever way they look.
  for (const bool turned : {false, true}) {
    ElementMesh mesh;
    add_polygon(mesh, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    add_polygon(mesh, {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}});
    if (turned) {
      for (auto& [a, b, c] : mesh.elements) std::swap(b, c);
    }
    mesh = one_by_one(std::move(mesh));
    const auto method = form_factor_method("analytic", mesh, {});
    Progress progress;
    const auto two =
        group_form_factors(*method, mesh, 2, {.two_sided = true, .patch = {}}, progress);
    EXPECT_NEAR(two.value[1], 0.199824895698387, 1e-12);
    const auto one = group_form_factors(*method, mesh, 2, {}, progress);
    EXPECT_EQ(one.value[1], 0.0) << "fronts look the same way";
  }
}

TEST(GroupMatrix, StopsWhenAsked) {
  class Impatient : public Progress {
    bool is_cancelled() const override { return true; }
  };
  const ElementMesh mesh = box_in_box();
  const auto method = form_factor_method("hemicube", mesh, {});
  Impatient progress;
  EXPECT_THROW(group_form_factors(*method, mesh, 12, {}, progress), Cancelled);
}

TEST(Polylines, LoseWhatChordsCutOff) {
  // A square of 2 m at 1 m over the point: Howell B-3 four times. Chords over t radians lose up to
  // t^2 / 6 of an area that is bounded by arcs, 2 % for 20 degrees.
  const double r = std::sqrt(2.0), whole = 4.0 / kPi / r * std::atan(1.0 / r);
  ElementMesh mesh;
  add_polygon(mesh, {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}});
  const auto total = [&](double polyline_deg) {
    double sum = 0.0;
    for (const FormFactor& f :
         form_factor_method("hemisphere-scanline", mesh,
                            {.resolution = 4096, .polyline_deg = polyline_deg})
             ->from_point({0, 0, 0}, kZenith)) {
      sum += f.value;
    }
    return sum;
  };
  EXPECT_NEAR(total(0.0), whole, 1e-5);  // 4,096 lines: 4096^-1.5 is 4e-6
  EXPECT_NEAR(total(1.0), whole, 6e-5 * whole);
  EXPECT_LT(total(20.0), whole * (1.0 - 0.002));
  EXPECT_GT(total(20.0), whole * (1.0 - 0.021));
}

TEST(PatchRow, TellsAnErrorThatCoversWhatItIsWrongBy) {
  // A wall stands on the edge of a floor: 0.200 043 776 (Howell C-14).
  ElementMesh mesh;
  add_polygon(mesh, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  add_polygon(mesh, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}});
  const auto method = form_factor_method("hemisphere-scanline", mesh, {.resolution = 512});
  for (const std::size_t points : {40U, 1000U}) {
    const PatchFormFactors patches(*method, mesh, {0, 0, 0, 0, 1, 1, 1, 1},
                                   {.most_points = points});
    for (const PatchFormFactor& f : patches.row(0, false)) {
      if (f.column == 0) continue;
      EXPECT_LT(std::abs(f.value - 0.200043776075403), f.error);
    }
  }
}

}  // namespace
}  // namespace tenku
