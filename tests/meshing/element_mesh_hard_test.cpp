// Surfaces as files have them: what goes wrong is mended or told.
#include <random>

#include "meshing/mesh_checks.h"
#include "meshing/point_tree.h"

namespace tenku::testing_support {
namespace {

/// An object for each number, so that findings have names.
MeshedScene meshed(const Surface& surface, const MeshOptions& options) {
  Scene scene;
  scene.materials = surface.materials;
  for (const char* id : {"first", "second", "third"})
    scene.objects.push_back({.id = id, .type = ""});
  return mesh_scene(scene, surface.soup, options);
}

const Finding* finding(const MeshedScene& made, const std::string& code) {
  const auto at = std::find_if(made.findings.begin(), made.findings.end(),
                               [&](const Finding& f) { return f.code == code; });
  return at == made.findings.end() ? nullptr : &*at;
}

/// Box of which the faces have vertices of their own, as most files have them.
void add_box(Surface& surface, Vec3 size) {
  const auto& [x, y, z] = size;
  surface.fan({{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}});
  surface.fan({{0, 0, z}, {0, y, z}, {x, y, z}, {x, 0, z}});
  surface.fan({{0, 0, 0}, {0, 0, z}, {x, 0, z}, {x, 0, 0}});
  surface.fan({{0, y, 0}, {x, y, 0}, {x, y, z}, {0, y, z}});
  surface.fan({{0, 0, 0}, {0, y, 0}, {0, y, z}, {0, 0, z}});
  surface.fan({{x, 0, 0}, {x, 0, z}, {x, y, z}, {x, y, 0}});
}

TEST(ElementMeshHard, SoundRoomHasNothingToTell) {
  Surface room;
  add_box(room, {6, 8, 3});
  const MeshedScene made = meshed(room, {.element_m = 0.5});
  EXPECT_TRUE(made.findings.empty()) << made.findings[0].what;
  EXPECT_NEAR(area_of(made.mesh), 180.0, 1e-10);
}

TEST(ElementMeshHard, VerticesThatNearlyMeetAreJoined) {
  // Four squares about a point, the vertices off by rounding of a file with seven digits.
  std::mt19937 chance(1);
  std::uniform_real_distribution<double> off(-1e-7, 1e-7);
  Surface surface;
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) surface.level(x, y, x + 1.0, y + 1.0);
  }
  for (Vec3& p : surface.soup.vertices) p = p + Vec3{off(chance), off(chance), off(chance)};
  const ElementMesh mesh = surface.mesh(0.35356);  // the diagonal of a quarter of a metre
  EXPECT_EQ(topology_of(mesh).euler(), 1);
  EXPECT_NEAR(topology_of(mesh).border_m, 8.0, 1e-5);
  EXPECT_NEAR(least_angle_deg(mesh), 45.0, 0.01);
}

TEST(ElementMeshHard, TrianglesTurnedEitherWayAreOneFront) {
  Surface surface;
  surface.level(0.0, 0.0, 2.0, 1.0);
  surface.fan({{0, 1, 0}, {0, 2, 0}, {2, 2, 0}});  // seen from below
  surface.fan({{0, 1, 0}, {2, 2, 0}, {2, 1, 0}});
  surface.level(0.0, 2.0, 2.0, 2.5);
  const ElementMesh mesh = surface.mesh(0.3);
  EXPECT_EQ(topology_of(mesh).euler(), 1);
  EXPECT_NEAR(area_of(mesh), 5.0, 1e-11);
  for (std::size_t e = 0; e < mesh.size(); ++e) EXPECT_GT(mesh.doubled_area(e).z, 0.0);
}

TEST(ElementMeshHard, TrianglesWithoutAreaAreLeftOutAndTold) {
  Surface surface;
  surface.object = 1;
  surface.level(0.0, 0.0, 2.0, 1.0);
  surface.fan({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  surface.fan({{1, 1, 0}, {1, 1, 0}, {1, 1, 0}});
  const MeshedScene made = meshed(surface, {.element_m = 0.5});
  EXPECT_NEAR(area_of(made.mesh), 2.0, 1e-12);
  const Finding* told = finding(made, "faces_without_area");
  ASSERT_NE(told, nullptr);
  EXPECT_EQ(told->count, 2U);
  EXPECT_EQ(told->object, "second");
}

TEST(ElementMeshHard, NeedleBetweenNeighboursDoesNotPartThem) {
  // The triangle (0 0), (1 0), (2 0) without area is all that joins one edge to two halves of it.
  Surface surface;
  surface.fan({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}});
  surface.fan({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  surface.fan({{0, 0, 0}, {1, -1, 0}, {1, 0, 0}});
  surface.fan({{1, 0, 0}, {1, -1, 0}, {2, 0, 0}});
  const ElementMesh mesh = surface.mesh(0.3);
  EXPECT_EQ(topology_of(mesh).euler(), 1);
  EXPECT_NEAR(topology_of(mesh).border_m, 4.0 * std::sqrt(2.0), 1e-9);
}

TEST(ElementMeshHard, WallThatIsThereTwiceIsDividedOnceAndTold) {
  Surface room;
  add_box(room, {6, 8, 3});
  room.object = 1;
  room.material = 1;
  // The wall at x = 6 again, seen from the other side and parted along the other diagonal.
  room.fan({{6, 0, 3}, {6, 0, 0}, {6, 8, 0}, {6, 8, 3}});
  const MeshedScene made = meshed(room, {.element_m = 0.5});
  EXPECT_NEAR(area_of(made.mesh), 180.0, 1e-10);
  const Finding* told = finding(made, "coincident_surfaces");
  ASSERT_NE(told, nullptr);
  EXPECT_EQ(told->object, "second");
  EXPECT_NE(told->what.find("[first]"), std::string::npos);
  EXPECT_EQ(finding(made, "overlapping_surfaces"), nullptr);
}

TEST(ElementMeshHard, FacesGivenFromBothSidesAreDividedOnceAndTold) {
  Surface room;
  add_box(room, {6, 8, 3});
  for (std::size_t t = 0, triangles = room.soup.size(); t < triangles; ++t) {
    const auto [a, b, c] = room.soup.triangles[t];
    room.soup.triangles.push_back({a, c, b});
    room.soup.material.push_back(0);
    room.soup.object.push_back(0);
    room.soup.surface_type.push_back(SurfaceType::Unknown);
  }
  const MeshedScene made = meshed(room, {.element_m = 0.5});
  EXPECT_NEAR(area_of(made.mesh), 180.0, 1e-10);
  ASSERT_EQ(made.findings.size(), 1U);
  EXPECT_EQ(made.findings[0].code, "duplicate_surfaces");
  EXPECT_EQ(made.findings[0].severity, Severity::Note);
  EXPECT_EQ(made.findings[0].count, 12U);
}

TEST(ElementMeshHard, FacesGivenTwiceWithOtherDiagonalsAreDividedOnce) {
  Surface surface;
  for (const double x : {0.0, 5.0}) {
    surface.fan({{x, 0, 0}, {x + 2, 0, 0}, {x + 2, 1, 0}, {x, 1, 0}});
    surface.fan({{x + 2, 0, 0}, {x, 0, 0}, {x, 1, 0}, {x + 2, 1, 0}});  // from below
  }
  const MeshedScene made = meshed(surface, {.element_m = 0.5});
  EXPECT_NEAR(area_of(made.mesh), 4.0, 1e-12);
  EXPECT_EQ(topology_of(made.mesh).euler(), 2);
  ASSERT_EQ(made.findings.size(), 1U);
  EXPECT_EQ(made.findings[0].code, "duplicate_surfaces");
  EXPECT_EQ(made.findings[0].count, 2U);
}

TEST(ElementMeshHard, HeapsOfTrianglesKeepTheirArea) {
  // Each square is there twice, and a quarter of it a third time.
  Surface surface;
  for (const double x : {0.0, 5.0}) {
    surface.fan({{x, 0, 0}, {x + 2, 0, 0}, {x + 2, 1, 0}, {x, 1, 0}});
    surface.fan({{x + 2, 0, 0}, {x + 2, 1, 0}, {x, 1, 0}, {x, 0, 0}});
    surface.fan({{x, 0, 0}, {x + 2, 0, 0}, {x + 1, 0.5, 0}});
  }
  const MeshedScene made = meshed(surface, {.element_m = 0.5});
  EXPECT_NEAR(area_of(made.mesh), 2.0 * (2.0 + 2.0 + 0.5), 1e-11);
  EXPECT_NE(finding(made, "overlapping_surfaces"), nullptr);
}

TEST(ElementMeshHard, SurfaceOnAPartOfAnotherIsTold) {
  Surface room;
  add_box(room, {6, 8, 3});
  room.object = 2;
  room.level(2.0, 3.0, 4.0, 5.0);  // a rug in the plane of the floor
  const MeshedScene made = meshed(room, {.element_m = 0.5});
  const Finding* told = finding(made, "overlapping_surfaces");
  ASSERT_NE(told, nullptr);
  EXPECT_NEAR(area_of(made.mesh), 184.0, 1e-10);
  for (std::size_t k = room.soup.vertices.size() - 4; k < room.soup.vertices.size(); ++k) {
    room.soup.vertices[k].z = 0.001;
  }
  EXPECT_EQ(finding(meshed(room, {.element_m = 0.5}), "overlapping_surfaces"), nullptr);
}

TEST(ElementMeshHard, OverlappingTrianglesOfOneSurfaceKeepTheirArea) {
  Surface surface;
  surface.fan({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}});
  surface.fan({{0, 0, 0}, {4, 0, 0}, {0, 3, 0}});
  const MeshedScene made = meshed(surface, {.element_m = 0.5});
  EXPECT_NEAR(area_of(made.mesh), 12.0, 1e-11);
  EXPECT_NE(finding(made, "overlapping_surfaces"), nullptr);
}

TEST(ElementMeshHard, GapUnderAWallIsTold) {
  Surface room;
  add_box(room, {6, 8, 3});
  room.object = 1;
  room.fan({{3, 0, 0.005}, {3, 8, 0.005}, {3, 8, 3}, {3, 0, 3}});  // stops 5 mm above the floor
  const MeshedScene made = meshed(room, {.element_m = 0.5});
  const Finding* told = finding(made, "gap_between_surfaces");
  ASSERT_NE(told, nullptr);
  EXPECT_EQ(told->count, 1U);
  EXPECT_EQ(told->object, "second");
  EXPECT_EQ(told->where, "3.00 4.00 0.01");  // middle of the edge
  EXPECT_NE(told->what.find(" 5 mm"), std::string::npos);
}

TEST(ElementMeshHard, TJunctionThatStopsShortIsTold) {
  // Two halves of a floor that should meet a third along one line, and miss it by 3 mm.
  Surface floor;
  floor.level(0.0, 0.0, 4.0, 2.0);
  floor.level(0.0, 2.003, 2.0, 4.0);
  floor.level(2.0, 2.003, 4.0, 4.0);
  const MeshedScene made = meshed(floor, {.element_m = 0.5});
  const Finding* told = finding(made, "gap_between_surfaces");
  ASSERT_NE(told, nullptr);
  EXPECT_NE(told->what.find(" 3 mm"), std::string::npos);
  EXPECT_EQ(topology_of(made.mesh).euler(), 2);  // the halves join, the first stays apart
}

TEST(ElementMeshHard, SliverIsDividedAlongItselfOnlyAndTold) {
  Surface surface;
  surface.fan({{0, 0, 0}, {5, 0, 0}, {5, 0.001, 0}});
  surface.level(0.0, 1.0, 5.0, 1.002);
  const MeshedScene made = meshed(surface, {.element_m = 0.5});
  EXPECT_NEAR(area_of(made.mesh), 0.0025 + 0.01, 1e-13);
  EXPECT_LE(made.mesh.size(), 60U);
  const Finding* told = finding(made, "sliver_surfaces");
  ASSERT_NE(told, nullptr);
  EXPECT_EQ(told->count, 2U);
}

TEST(ElementMeshHard, ElementsBelowTheStepsOfFloatsAreTold) {
  Surface near, far;
  near.level(0.0, 0.0, 4.0, 4.0);
  // 4,000 km off, where floats lie 0.25 m apart.
  far.level(4e6, 0.0, 4e6 + 400.0, 400.0);
  EXPECT_EQ(finding(meshed(near, {.element_m = 0.5}), "elements_below_float"), nullptr);
  const MeshedScene made = meshed(far, {.element_m = 5.0});
  EXPECT_NEAR(area_of(made.mesh), 160'000.0, 1e-4);
  ASSERT_NE(finding(made, "elements_below_float"), nullptr);
  EXPECT_EQ(finding(meshed(far, {.element_m = 200.0}), "elements_below_float"), nullptr);
}

TEST(ElementMeshHard, HugePolygonBesideTinyOnes) {
  Surface surface;
  surface.level(0.0, 0.0, 10'000.0, 10'000.0);
  for (int k = 0; k < 100; ++k) {
    surface.level(100.0 * k, 0.0, 100.0 * k + 0.05, 0.05, 1.0);
  }
  const ElementMesh mesh = surface.mesh(0.0);
  EXPECT_NEAR(area_of(mesh), 1e8 + 100 * 0.0025, 1e-3);
  EXPECT_GE(mesh.size(), 1000U + 200U);
  EXPECT_LE(mesh.size(), 60'000U);
}

TEST(ElementMeshHard, TooManyPolygonsForTheNumberAllowedIsTold) {
  Surface surface;
  for (int k = 0; k < 30; ++k) surface.level(2.0 * k, 0.0, 2.0 * k + 1.0, 1.0);
  const MeshedScene made = meshed(surface, {.elements_max = 20});
  EXPECT_EQ(made.mesh.size(), 60U);
  EXPECT_NE(finding(made, "elements_max_passed"), nullptr);
}

TEST(ElementMeshHard, RoundColumnStaysRound) {
  // 256 strips that bend by 1.4 degrees each: none is joined to the next.
  Surface column;
  for (int k = 0; k < 256; ++k) {
    const double a = 2.0 * kPi * k / 256.0, b = 2.0 * kPi * (k + 1) / 256.0;
    column.fan({{std::cos(a), std::sin(a), 0},
                {std::cos(b), std::sin(b), 0},
                {std::cos(b), std::sin(b), 3},
                {std::cos(a), std::sin(a), 3}});
  }
  const ElementMesh mesh = column.mesh(10.0);
  EXPECT_EQ(mesh.size(), 512U);
  EXPECT_NEAR(area_of(mesh), 256.0 * 3.0 * 2.0 * std::sin(kPi / 256.0), 1e-10);
}

TEST(ElementMeshHard, PointsNearSegmentsAreFoundAsBySearchOfAll) {
  std::mt19937 chance(2);
  std::uniform_real_distribution<double> at(0.0, 10.0);
  std::vector<Vec3> points;
  // Half of them on the lattice of whole metres, where many have a coordinate in common.
  for (int k = 0; k < 2000; ++k) {
    const Vec3 p{at(chance), at(chance), at(chance)};
    points.push_back(k % 2 == 0 ? p : Vec3{std::floor(p.x), std::floor(p.y), std::floor(p.z)});
  }
  const PointTree tree(points);
  for (int k = 0; k < 300; ++k) {
    const Vec3 a = points[static_cast<std::size_t>(7 * k % 2000)],
               b = points[static_cast<std::size_t>(11 * k % 2000)];
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      if (distance_to_segment(points[i], a, b) <= 0.3) near.push_back(i);
    }
    EXPECT_EQ(tree.near_segment(a, b, 0.3), near);
  }
}

}  // namespace
}  // namespace tenku::testing_support
