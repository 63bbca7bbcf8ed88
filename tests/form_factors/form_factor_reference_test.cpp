// Form factors against values of others: tests/reference/radiosity/form_factors.csv has 80 of them,
// closed forms evaluated with 60 digits and contour integrals with 25 (J. R. Howell's catalogue of
// configuration factors, C-11, C-13 to C-15, C-41; Lambert's formula), among them touching edges,
// gaps of 1e-4 and distances of 1e4.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "form_factor_mesh.h"
#include "form_factors/patch_form_factors.h"
#include "support/reference_table.h"

namespace tenku {
namespace {

using Ring = std::vector<Vec3>;

struct Case {
  std::string id, kind;
  Ring from, to, blocker;
  Vec3 normal;
  double form_factor;
};

/// A polygon of the area of a disc, so that what it differs by is of second order only.
Ring disc(double radius, double height, int corners) {
  const double turn = 2.0 * kPi / corners, out = radius * std::sqrt(turn / std::sin(turn));
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    ring.push_back({out * std::cos(k * turn), out * std::sin(k * turn), height});
  }
  return ring;
}

Ring ring_of(const std::string& text) {
  Ring ring;
  std::stringstream corners(text);
  for (std::string corner; std::getline(corners, corner, ';');) {
    std::stringstream numbers(corner);
    Vec3 v;
    numbers >> v.x >> v.y >> v.z;
    ring.push_back(v);
  }
  return ring;
}

std::vector<Case> cases_of(const std::string& kind, int disc_corners = 72) {
  const testing_support::ReferenceTable table(TENKU_TEST_REFERENCE "/radiosity/form_factors.csv");
  std::vector<Case> cases;
  for (std::size_t row = 0; row < table.size(); ++row) {
    if (table.text(row, "kind") != kind) continue;
    Case one{table.text(row, "id"),           kind, {}, {}, ring_of(table.text(row, "blocker")), {},
             table.number(row, "form_factor")};
    if (kind == "coaxial_discs") {
      double radius = 0.0, height = 0.0;
      std::stringstream(table.text(row, "to")) >> radius >> height;
      one.from = disc(table.number(row, "from"), 0.0, disc_corners);
      one.to = disc(radius, height, disc_corners);
    } else {
      one.from = ring_of(table.text(row, "from")), one.to = ring_of(table.text(row, "to"));
    }
    const Ring normal = ring_of(table.text(row, "normal"));
    if (!normal.empty()) one.normal = normal.front();
    cases.push_back(one);
  }
  return cases;
}

/// From both sides of the first polygon to both sides of the second.
double form_factor(const Case& one, std::string_view name, int resolution,
                   const PatchFormFactorOptions& options) {
  ElementMesh mesh;
  add_polygon(mesh, one.from);
  add_polygon(mesh, one.to);
  if (!one.blocker.empty()) add_polygon(mesh, one.blocker);
  std::vector<Column> column;
  for (std::size_t side = 0; side < mesh.sides(); ++side) column.push_back(mesh.object[side / 2]);
  const auto method = form_factor_method(name, mesh, {.resolution = resolution});
  const PatchFormFactors patches(*method, mesh, column, options);
  double sum = 0.0;
  for (const bool back : {false, true}) {
    for (const PatchFormFactor& f : patches.row(0, back)) sum += f.column == 1 ? f.value : 0.0;
  }
  return sum;
}

double from_point(const Case& one, std::string_view name, int resolution) {
  ElementMesh mesh;
  add_polygon(mesh, one.to);
  double sum = 0.0;
  for (const FormFactor& f : form_factor_method(name, mesh, {.resolution = resolution})
                                 ->from_point(one.from.front(), one.normal)) {
    sum += f.value;
  }
  return sum;
}

class ReferenceFormFactors : public testing::TestWithParam<std::string> {};

TEST_P(ReferenceFormFactors, AreMetByContourIntegralsWithinAMillionth) {
  for (const Case& one : cases_of(GetParam())) {
    const PatchFormFactorOptions options{
        .relative_tolerance = 5e-8, .absolute_tolerance = 1e-8, .most_points = 40000};
    const double found = form_factor(one, "analytic", 128, options);
    EXPECT_NEAR(found, one.form_factor, 1e-6 * one.form_factor + 1e-15) << one.id;
  }
}

TEST_P(ReferenceFormFactors, AreMetBy512ScanLinesWithinHalfAPercent) {
  const std::size_t points = GetParam() == "coaxial_discs"               ? 60
                             : GetParam() == "perpendicular_common_edge" ? 1000
                                                                         : 2000;
  for (const Case& one : cases_of(GetParam(), 24)) {
    const PatchFormFactorOptions options{.absolute_tolerance = 1e-6, .most_points = points};
    const double found = form_factor(one, "hemisphere-scanline", 512, options);
    EXPECT_NEAR(found, one.form_factor, 0.005 * one.form_factor + 1e-6 * (one.form_factor == 0.0))
        << one.id;
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, ReferenceFormFactors,
                         testing::Values("parallel_aligned", "parallel_offset",
                                         "perpendicular_common_edge", "perpendicular_general",
                                         "coaxial_discs", "general_polygons",
                                         "parallel_with_blocker"),
                         [](const auto& test) { return test.param; });

TEST(ReferenceFormFactorsFromPoints, AreMet) {
  int points = 0;
  for (const std::string kind : {"element_to_polygon", "element_to_polygon_clipped"}) {
    for (const Case& one : cases_of(kind)) {
      ++points;
      // Rows are stored as float, which rounds by 6e-8.
      EXPECT_NEAR(from_point(one, "analytic", 128), one.form_factor, 1e-6 * one.form_factor)
          << one.id;
      EXPECT_NEAR(from_point(one, "hemisphere-scanline", 512), one.form_factor,
                  0.005 * one.form_factor)
          << one.id;
    }
  }
  EXPECT_EQ(points, 16);
}

}  // namespace
}  // namespace tenku
