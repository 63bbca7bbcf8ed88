// Edges of shadows against their places by similar triangles.
#include "radiosity/shadow_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "meshing/mesh_checks.h"

namespace tenku {
namespace {

using testing_support::Surface;

struct Found {
  std::vector<FlatPolygon> polygons;
  std::vector<ShadowEdges> edges;

  Found(const Surface& surface, const std::optional<Vec3>& sun) {
    polygons = join_coplanar(surface.soup, surface.materials, {}).polygons;
    const RayVisibility rays(surface.soup, surface.materials);
    edges = shadow_edges(polygons, surface.materials, rays, sun);
  }
};

double length_of(const std::vector<ConstraintSegment>& lines) {
  double sum = 0.0;
  for (const auto& [a, b] : lines) sum += std::hypot(b.x - a.x, b.y - a.y);
  return sum;
}

/// Whether all lines lie on the outline of a level rectangle, given in the scene's coordinates.
void expect_on_rectangle(const FlatPolygon& floor, const std::vector<ConstraintSegment>& lines,
                         double x0, double y0, double x1, double y1) {
  for (const auto& line : lines) {
    for (const PlanePoint end : {line.a, line.b}) {
      const Vec3 p = floor.lifted(end);
      const double off = std::min(
          {std::abs(p.x - x0), std::abs(p.x - x1), std::abs(p.y - y0), std::abs(p.y - y1)});
      EXPECT_LT(off, 1e-9) << p.x << " " << p.y;
      EXPECT_GE(p.x, x0 - 1e-9);
      EXPECT_LE(p.x, x1 + 1e-9);
      EXPECT_GE(p.y, y0 - 1e-9);
      EXPECT_LE(p.y, y1 + 1e-9);
    }
  }
}

TEST(ShadowEdges, OfTheSunLieWhereTheSunThrowsThem) {
  Surface surface;
  surface.level(-5, -5, 5, 5);
  surface.level(0, 0, 1, 2, 1.5);
  // From the east, 45 degrees high: the shadow lies 1.5 m to the west.
  const Found found(surface, normalized(Vec3{1, 0, 1}));
  EXPECT_NEAR(length_of(found.edges[0].shadows), 6.0, 1e-9);
  expect_on_rectangle(found.polygons[0], found.edges[0].shadows, -1.5, 0.0, -0.5, 2.0);
  EXPECT_TRUE(found.edges[1].shadows.empty());
  EXPECT_TRUE(found.edges[0].contacts.empty());
}

TEST(ShadowEdges, AreCutWhereAnotherShadowCoversThem) {
  Surface surface;
  surface.level(-5, -5, 5, 5);
  surface.level(0, 0, 2, 2, 1.0);
  surface.level(1, 1, 3, 3, 2.0);
  const Found found(surface, Vec3{0, 0, 1});
  // The outline of two squares of 4 m2 that overlap by 1 m2: 8 + 8 - 4 metres.
  EXPECT_NEAR(length_of(found.edges[0].shadows), 12.0, 1e-9);
  // The upper square shades the lower one along two of its edges, inside for a metre each.
  EXPECT_NEAR(length_of(found.edges[1].shadows), 2.0, 1e-9);
}

TEST(ShadowEdges, OfALampBoundUmbraAndPenumbra) {
  Surface surface;
  surface.materials[1].emission_lm_m2 = Rgb::grey(100.0);
  surface.level(-5, -5, 5, 5);
  surface.level(-0.5, -0.5, 0.5, 0.5, 1.0);
  surface.material = 1;
  surface.level(-0.1, -0.1, 0.1, 0.1, 2.0);
  const Found found(surface, {});
  // Halfway up: corners of the lamp at 0.1 throw the edge at 0.5 to 0.9, where nothing of the lamp
  // is seen any more, and to 1.1, where all of it is.
  std::vector<ConstraintSegment> inner, outer;
  for (const ConstraintSegment& line : found.edges[0].shadows) {
    const Vec3 a = found.polygons[0].lifted(line.a), b = found.polygons[0].lifted(line.b);
    const Vec3 middle = 0.5 * (a + b);
    const bool is_inner = std::max(std::abs(middle.x), std::abs(middle.y)) < 1.0;
    (is_inner ? inner : outer).push_back(line);
  }
  expect_on_rectangle(found.polygons[0], inner, -0.9, -0.9, 0.9, 0.9);
  expect_on_rectangle(found.polygons[0], outer, -1.1, -1.1, 1.1, 1.1);
  EXPECT_NEAR(length_of(inner), 4 * 1.8, 1e-6);
  EXPECT_NEAR(length_of(outer), 4 * 2.2, 1e-6);
}

TEST(ShadowEdges, AreThoseOfWhatStandsOnASurface) {
  Surface surface;
  surface.level(-5, -5, 5, 5);
  surface.fan({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}});  // a wall on it
  surface.fan({{0, 5, 0}, {1, 5, 0}, {1, 5, 1}, {0, 5, 1}});  // one along its edge
  const Found found(surface, {});
  EXPECT_NEAR(length_of(found.edges[0].contacts), 1.0, 1e-9);
  EXPECT_TRUE(found.edges[0].shadows.empty());
}

TEST(ShadowEdges, StayInsideOfAPolygonWithANotch) {
  Surface surface;
  // An L of two rectangles: 4 x 2 and 2 x 2 above its left half.
  surface.fan({{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 0}, {0, 2, 0}});
  surface.fan({{0, 2, 0}, {2, 2, 0}, {2, 4, 0}, {0, 4, 0}});
  surface.level(1, 1, 3, 3, 1.0);
  const Found found(surface, Vec3{0, 0, 1});
  // Of the square's outline of 8 m, 1 m of the right and 1 m of the upper edge fall into the notch.
  EXPECT_NEAR(length_of(found.edges[0].shadows), 6.0, 1e-9);
}

}  // namespace
}  // namespace tenku
