// Splitting and parting meshes: they conform, keep their area, and angles do not get worse.
#include "meshing/split_mesh.h"

#include <gtest/gtest.h>

#include <numbers>

#include "meshing/flat_polygon.h"
#include "meshing/mesh_checks.h"
#include "meshing/mesh_pieces.h"
#include "meshing/parted_mesh.h"

namespace tenku {
namespace {

using testing_support::Surface;

struct OneSquare {
  std::vector<FlatPolygon> polygons;
  PolygonMesh mesh;

  explicit OneSquare(double side, double element_m) {
    Surface surface;
    surface.level(0, 0, side, side);
    polygons = join_coplanar(surface.soup, surface.materials, {}).polygons;
    mesh = *grid_mesh(polygons[0], element_m, 1e-6);
  }
};

ElementMesh elements_of(const PolygonMesh& mesh) {
  ElementMesh all;
  all.vertices = mesh.vertices;
  all.elements = mesh.elements;
  return all;
}

TEST(SplitMesh, ConformsHoweverOftenOneCornerIsSplit) {
  const OneSquare square(4.0, 1.5);
  SplitMesh split(square.mesh);
  for (int round = 0; round < 8; ++round) {
    const ElementMesh before = elements_of(split.conforming());
    std::vector<std::uint8_t> is_wanted(before.size());
    for (std::size_t e = 0; e < before.size(); ++e) {
      for (const std::uint32_t v : before.elements[e]) {
        is_wanted[e] |= length(before.vertices[v]) < 1e-9;
      }
    }
    split.split(is_wanted);
    const ElementMesh after = elements_of(split.conforming());
    EXPECT_GT(after.size(), before.size());
    EXPECT_NEAR(testing_support::area_of(after), 16.0, 1e-12);
    const auto topology = testing_support::topology_of(after);
    EXPECT_EQ(topology.crowded_edges, 0);
    EXPECT_EQ(topology.euler(), 1);
    EXPECT_NEAR(topology.border_m, 16.0, 1e-12);  // a vertex on an edge would add to it
    // Half of an angle of 45 degrees in the triangles that close the mesh, once and not more.
    EXPECT_GE(testing_support::least_angle_deg(after), 18.4);  // atan(1/3)
  }
}

TEST(SplitMesh, SplitsAllIntoFour) {
  const OneSquare square(4.0, 1.5);
  SplitMesh split(square.mesh);
  split.split(std::vector<std::uint8_t>(square.mesh.elements.size(), 1));
  EXPECT_EQ(split.conforming().elements.size(), 4 * square.mesh.elements.size());
}

TEST(PartedMesh, ComesApartAlongALineAndStaysOneAtItsEnd) {
  const OneSquare square(4.0, 1.5);
  const std::size_t whole = square.mesh.vertices.size();
  const FlatPolygon& polygon = square.polygons[0];
  // A middle line from edge to edge parts all vertices on it, half of it all but its end.
  const auto line = [&](Vec3 a, Vec3 b) {
    return std::vector<ConstraintSegment>{{polygon.flat(a), polygon.flat(b)}};
  };
  const auto count_on = [&](Vec3 a, Vec3 b) {
    std::size_t on = 0;
    for (const Vec3 v : square.mesh.vertices) {
      on += length(v - a) + length(b - v) < length(b - a) + 1e-9;
    }
    return on;
  };
  const Vec3 a{2, 0, 0}, b{2, 4, 0}, middle{2, 2, 0};
  const auto through = parted_along(polygon, square.mesh, line(a, b));
  EXPECT_EQ(through.vertices.size(), whole + count_on(a, b));
  EXPECT_GE(count_on(a, b), 3U);
  const auto into = parted_along(polygon, square.mesh, line(a, middle));
  EXPECT_EQ(into.vertices.size(), whole + count_on(a, middle) - 1);
  EXPECT_EQ(testing_support::topology_of(elements_of(through)).euler(), 2);
  EXPECT_EQ(testing_support::topology_of(elements_of(into)).euler(), 1);
}

TEST(MeshPieces, GiveTheMeshThatTheyWereTakenFrom) {
  Surface surface;
  surface.level(0, 0, 4, 3);
  surface.fan({{0, 0, 1}, {3, 0, 1}, {4, 2, 1}, {1, 3, 1}});
  const auto polygons = join_coplanar(surface.soup, surface.materials, {}).polygons;
  std::vector<MeshPiece> pieces;
  for (const FlatPolygon& p : polygons) {
    pieces.push_back(grouped_piece(p, delaunay_mesh(p, 0.5), 1.0));
  }
  const AssembledMesh all = assembled(polygons, pieces);
  const auto again = pieces_of(all.mesh, all.polygon_of, polygons.size());
  const AssembledMesh twice = assembled(polygons, again);
  ASSERT_EQ(twice.mesh.size(), all.mesh.size());
  EXPECT_EQ(twice.mesh.patch_begin, all.mesh.patch_begin);
  for (std::size_t e = 0; e < all.mesh.size(); ++e) {
    EXPECT_EQ(twice.mesh.centre(e), all.mesh.centre(e));
  }
  EXPECT_NEAR(testing_support::area_of(all.mesh), 12.0 + polygons[1].area_m2, 1e-12);
}

}  // namespace
}  // namespace tenku
