// Surfaces divided into elements: areas, outlines and topology are those of the polygons, known
// from elementary geometry.
#include <random>

#include "core/error.h"
#include "core/parallel.h"
#include "meshing/mesh_checks.h"

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

/// The same surface turned in space, so that no edge is along an axis.
Surface turned(Surface surface) {
  const Vec3 normal = normalized({0.3, -0.5, 0.81});
  const TangentFrame frame = tangent_frame(normal);
  for (Vec3& p : surface.soup.vertices) {
    p = Vec3{12.0, -7.0, 3.0} + p.x * frame.tangent + p.y * frame.bitangent + p.z * normal;
  }
  return surface;
}

/// Outline of a star with `points` points, about the origin: not convex, no right angles.
std::vector<Vec3> star(int points, double inner, double outer) {
  std::vector<Vec3> corners;
  for (int k = 0; k < 2 * points; ++k) {
    const double turn = kPi * k / points, r = k % 2 == 0 ? outer : inner;
    corners.push_back({r * std::cos(turn), r * std::sin(turn), 0.0});
  }
  return corners;
}

/// As a fan about the middle, in which every triangle is inside.
Surface fan_about_origin(const std::vector<Vec3>& corners) {
  Surface surface;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    surface.fan({{0.0, 0.0, 0.0}, corners[k], corners[(k + 1) % corners.size()]});
  }
  return surface;
}

double largest_patch_diagonal(const ElementMesh& mesh) {
  // The box of a patch along the axes of its polygon has at most this diagonal, so has no two
  // points farther apart.
  double largest = 0.0;
  for (std::size_t p = 0; p < mesh.patches(); ++p) {
    std::vector<Vec3> points;
    for (std::size_t e = mesh.patch_begin[p]; e < mesh.patch_begin[p + 1]; ++e) {
      for (const std::uint32_t v : mesh.elements[e]) points.push_back(mesh.vertices[v]);
    }
    for (const Vec3 a : points) {
      for (const Vec3 b : points) largest = std::max(largest, length(a - b));
    }
  }
  return largest;
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

TEST(ElementMesh, SmallRectangleIsTwoTriangles) {
  Surface surface;
  surface.level(0.0, 0.0, 0.6, 0.5);
  const ElementMesh mesh = surface.mesh(1.0);
  EXPECT_EQ(mesh.size(), 2U);
  EXPECT_EQ(mesh.patches(), 1U);
}

TEST(ElementMesh, WallOfFourStripsIsOnePolygonWithAHole) {
  for (const Surface& wall : {wall_about_window(), turned(wall_about_window())}) {
    const ElementMesh mesh = wall.mesh(0.4, 1.0);
    EXPECT_NEAR(area_of(mesh), 18.0 - 4.5, 18.0 * kRounding);
    const Topology topology = topology_of(mesh);
    EXPECT_EQ(topology.euler(), 0);  // one piece, one hole
    EXPECT_EQ(topology.crowded_edges, 0);
    EXPECT_NEAR(topology.border_m, 18.0 + 9.0, 1e-9);
    EXPECT_LE(longest_edge(mesh), 0.4 * (1.0 + 1e-9));
    EXPECT_LE(largest_patch_diagonal(mesh), 1.0 * (1.0 + 1e-9));
    EXPECT_GE(least_angle_deg(mesh), 25.0);
  }
}

TEST(ElementMesh, TrapeziumIsWellShaped) {
  Surface surface;
  surface.fan({{0, 0, 0}, {10, 0, 0}, {7, 4, 3}, {3, 4, 3}});
  const ElementMesh mesh = surface.mesh(0.5, 1.5);
  EXPECT_NEAR(area_of(mesh), 0.5 * (10.0 + 4.0) * 5.0, 35.0 * kRounding);
  EXPECT_EQ(topology_of(mesh).euler(), 1);
  EXPECT_LE(longest_edge(mesh), 0.5 * (1.0 + 1e-9));
  EXPECT_LE(largest_patch_diagonal(mesh), 1.5 * (1.0 + 1e-9));
  EXPECT_GE(least_angle_deg(mesh), 20.0);
}

/// Polygon about the origin whose corners lie on an ellipse; nothing where an edge is shorter than
/// `edge_m` or a corner sharper than 60 degrees.
std::vector<Vec3> round_polygon(std::mt19937& chance, double edge_m) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const int corners = 5 + static_cast<int>(6.0 * share(chance));
  const double rx = 1.0 + 3.0 * share(chance), ry = 1.0 + 3.0 * share(chance);
  std::vector<Vec3> ring;
  for (int k = 0; k < corners; ++k) {
    const double turn = 2.0 * kPi * (k + 0.7 * share(chance)) / corners;
    ring.push_back({rx * std::cos(turn), ry * std::sin(turn), 0.0});
  }
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec3 before = ring[(k + 1) % ring.size()] - ring[k];
    const Vec3 after = ring[(k + 2) % ring.size()] - ring[(k + 1) % ring.size()];
    if (length(before) < edge_m || angle_between(before, after) > Angle::degrees(120)) return {};
  }
  return ring;
}

TEST(ElementMesh, AnglesAreTwentyDegreesAtLeastWhereThePolygonLets) {
  std::mt19937 chance(5);
  int polygons = 0;
  for (int k = 0; k < 300; ++k) {
    const double element_m = 0.2 + 0.002 * (k % 200);
    const auto ring = round_polygon(chance, element_m);
    if (ring.empty()) continue;
    Surface surface;
    surface.fan(ring);
    const ElementMesh mesh = surface.mesh(element_m);
    EXPECT_GE(least_angle_deg(mesh), 20.0) << "polygon " << k;
    EXPECT_LE(longest_edge(mesh), element_m * (1.0 + 1e-9));
    EXPECT_EQ(topology_of(mesh).euler(), 1);
    ++polygons;
  }
  EXPECT_GE(polygons, 200);
}

TEST(ElementMesh, StarIsOnePolygonInItsPlane) {
  const Surface surface = turned(fan_about_origin(star(7, 2.0, 4.0)));
  const ElementMesh mesh = surface.mesh(0.6, 1.5);
  // Of two radii and the angle between them, fourteen times.
  const double area = 14.0 * 0.5 * 2.0 * 4.0 * std::sin(kPi / 7.0);
  EXPECT_NEAR(area_of(mesh), area, area * kRounding);
  EXPECT_EQ(topology_of(mesh).euler(), 1);
  const double edge = std::sqrt(4.0 + 16.0 - 2.0 * 8.0 * std::cos(kPi / 7.0));
  EXPECT_NEAR(topology_of(mesh).border_m, 14.0 * edge, 1e-9);
  const Vec3 normal = normalized({0.3, -0.5, 0.81});
  for (const Vec3 p : mesh.vertices) {
    EXPECT_NEAR(dot(p - Vec3{12.0, -7.0, 3.0}, normal), 0.0, 1e-12);
  }
  for (std::size_t e = 0; e < mesh.size(); ++e) EXPECT_GT(dot(mesh.doubled_area(e), normal), 0.0);
  // The points have 56 degrees; nothing else is sharp.
  EXPECT_GE(least_angle_deg(mesh), 20.0);
}

TEST(ElementMesh, PatchesHangTogether) {
  // A comb: halves of its box fall into teeth.
  Surface comb;
  comb.level(0.0, 0.0, 9.0, 0.5);
  for (int tooth = 0; tooth < 5; ++tooth) comb.level(2.0 * tooth, 0.5, 2.0 * tooth + 1.0, 4.0);
  const ElementMesh mesh = comb.mesh(0.75, 5.0);
  EXPECT_EQ(topology_of(mesh).euler(), 1);
  for (std::size_t p = 0; p < mesh.patches(); ++p) {
    ElementMesh patch;
    patch.vertices = mesh.vertices;
    patch.elements.assign(mesh.elements.begin() + mesh.patch_begin[p],
                          mesh.elements.begin() + mesh.patch_begin[p + 1]);
    EXPECT_EQ(topology_of(patch).euler(), 1) << "patch " << p;
  }
}

TEST(ElementMesh, MaterialsObjectsAndFoldsPartPolygons) {
  Surface surface;
  surface.level(0.0, 0.0, 1.0, 1.0);
  surface.material = 1;
  surface.level(1.0, 0.0, 2.0, 1.0);
  surface.object = 1;
  surface.level(2.0, 0.0, 3.0, 1.0);
  surface.fan({{3, 0, 0}, {3, 0, 1}, {3, 1, 1}, {3, 1, 0}});
  const ElementMesh mesh = surface.mesh(10.0);
  EXPECT_EQ(mesh.size(), 8U);
  EXPECT_EQ(mesh.vertices.size(), 16U);  // nothing is shared across
  EXPECT_EQ(mesh.material, (std::vector<std::uint32_t>{0, 0, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(mesh.object, (std::vector<std::uint32_t>{0, 0, 0, 0, 1, 1, 1, 1}));
}

TEST(ElementMesh, GlassIsNoElement) {
  Surface surface;
  surface.level(0.0, 0.0, 1.0, 1.0);
  surface.materials[1].transmittance = 0.8;
  surface.material = 1;
  surface.level(1.0, 0.0, 2.0, 1.0);
  EXPECT_NEAR(area_of(surface.mesh(0.1)), 1.0, 1e-12);
}

TEST(ElementMesh, IsTheSameForAnyNumberOfThreads) {
  Surface surface = turned(wall_about_window());
  for (int k = 0; k < 40; ++k) {
    Surface more = fan_about_origin(star(5 + k % 7, 1.0 + 0.05 * k, 3.0));
    for (Vec3& p : more.soup.vertices) p = p + Vec3{0.0, 0.0, 1.0 * k};
    surface.add(more);
  }
  std::vector<ElementMesh> meshes;
  for (const unsigned threads : {1U, 2U, 0U}) {
    const ThreadLimit limit(threads);
    meshes.push_back(surface.mesh(0.3));
  }
  for (const ElementMesh& mesh : meshes) {
    EXPECT_TRUE(mesh.vertices == meshes[0].vertices);
    EXPECT_TRUE(mesh.elements == meshes[0].elements);
    EXPECT_TRUE(mesh.patch_begin == meshes[0].patch_begin);
  }
}

TEST(ElementMesh, NumberOfElementsIsNotPassedAndNearlyReached) {
  Surface surface = wall_about_window();
  surface.fan({{0, 0, 1}, {10, 0, 1}, {7, 4, 4}, {3, 4, 4}});
  for (const std::size_t most : {50U, 500U, 5000U, 50'000U}) {
    const ElementMesh mesh = mesh_surfaces(surface.soup, surface.materials, {.elements_max = most});
    EXPECT_LE(mesh.size(), most);
    EXPECT_GE(mesh.size(), most / 2);
  }
}

TEST(ElementMesh, SizesThatCannotBeAreRefused) {
  Surface surface;
  surface.level(0.0, 0.0, 1.0, 1.0);
  EXPECT_THROW(surface.mesh(-1.0), InputError);
  EXPECT_THROW(surface.mesh(std::nan("")), InputError);
  EXPECT_THROW(surface.mesh(1.0, std::numeric_limits<double>::infinity()), InputError);
  EXPECT_THROW(surface.mesh(1e-6), InputError);  // a million million elements
  surface.materials.clear();
  EXPECT_THROW(surface.mesh(1.0), InputError);
}

TEST(ElementMesh, NothingGivesNothing) {
  EXPECT_EQ(Surface().mesh(1.0).size(), 0U);
  EXPECT_EQ(Surface().mesh(0.0).patches(), 0U);
  Surface point;
  point.fan({{}, {}, {}});
  EXPECT_EQ(point.mesh(0.0).size(), 0U);
}

}  // namespace
}  // namespace tenku::testing_support
