// Surfaces divided into elements: areas, outlines and topology are those of the polygons, known
// from elementary geometry.
#include "radiosity/mesh_checks.h"

namespace tenku::testing_support {
namespace {

constexpr double kRounding = 1e-12;

/// A wall of 6 m by 3 m about a window of 3 m by 1.5 m, as four strips that meet in T-junctions.
Surface wall_about_window() {
  Surface wall;
  wall.level(0.0, 0.0, 1.5, 3.0);
  wall.level(4.5, 0.0, 6.0, 3.0);
  wall.level(1.5, 0.0, 4.5, 0.9);
  wall.level(1.5, 2.4, 4.5, 3.0);
  return wall;
}

TEST(ElementMesh, RectangleIsCutIntoRegularRightTriangles) {
  Surface surface;
  surface.level(0.0, 0.0, 4.0, 3.0);
  // Squares of half a metre have diagonals of 0.707 m.
  const ElementMesh mesh = surface.mesh(0.70711, 1.41422);
  EXPECT_EQ(mesh.size(), 2U * 8U * 6U);
  EXPECT_EQ(mesh.vertices.size(), 9U * 7U);
  EXPECT_EQ(mesh.patches(), 12U);
  EXPECT_NEAR(area_of(mesh), 12.0, 12.0 * kRounding);
  EXPECT_NEAR(least_angle_deg(mesh), 45.0, 1e-9);
  for (std::size_t p = 0; p < mesh.patches(); ++p) EXPECT_NEAR(mesh.patch_area_m2(p), 1.0, 1e-12);
}

TEST(ElementMesh, WallOfFourStripsIsOnePolygonWithAHole) {
  const ElementMesh mesh = wall_about_window().mesh(0.4, 1.0);
  EXPECT_NEAR(area_of(mesh), 18.0 - 4.5, 18.0 * kRounding);
  const Topology topology = topology_of(mesh);
  EXPECT_EQ(topology.euler(), 0);  // one piece, one hole
  EXPECT_EQ(topology.crowded_edges, 0);
  EXPECT_NEAR(topology.border_m, 18.0 + 9.0, 1e-9);
  EXPECT_LE(longest_edge(mesh), 0.4 * (1.0 + 1e-9));
}

TEST(ElementMesh, TrapeziumIsWellShaped) {
  Surface surface;
  surface.fan({{0, 0, 0}, {10, 0, 0}, {7, 4, 3}, {3, 4, 3}});
  const ElementMesh mesh = surface.mesh(0.5, 1.5);
  EXPECT_NEAR(area_of(mesh), 0.5 * (10.0 + 4.0) * 5.0, 35.0 * kRounding);
  EXPECT_EQ(topology_of(mesh).euler(), 1);
  EXPECT_LE(longest_edge(mesh), 0.5 * (1.0 + 1e-9));
  EXPECT_GE(least_angle_deg(mesh), 25.0);
}

}  // namespace
}  // namespace tenku::testing_support
