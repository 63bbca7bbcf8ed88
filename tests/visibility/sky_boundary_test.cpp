// Edges that bound the sky of a point, in scenes where it is known which they are.
#include "visibility/sky_boundary.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "support/test_scene.h"

namespace tenku {
namespace {

using testing_support::TestScene;

std::vector<BoundaryPiece> boundary(const TestScene& scene, Vec3 origin, Vec3 normal = kZenith) {
  const RayVisibility rays(scene.soup, scene.materials);
  std::uint64_t sent = 0;
  const auto pieces = sky_boundary(rays, origin, normal, sent);
  EXPECT_TRUE(pieces);
  return pieces ? *pieces : std::vector<BoundaryPiece>{};
}

/// Angle between the directions to the ends, degrees.
double length_deg(const BoundaryPiece& piece) {
  return std::acos(dot(normalized(piece.a), normalized(piece.b))) * 180.0 / kPi;
}

double length_deg(const std::vector<BoundaryPiece>& pieces) {
  double sum = 0.0;
  for (const BoundaryPiece& piece : pieces) sum += length_deg(piece);
  return sum;
}

TEST(SharpEdge, OfABoxAreTwelveAndOfASquareFour) {
  TestScene box, square;
  box.box({0, 0, 0}, {2, 3, 4});
  square.level({0, 0, 1, 1}, 3);
  EXPECT_EQ(few_sharp_edges(box.soup, MeshAdjacency(box.soup), 100).size(), 12U);
  EXPECT_EQ(few_sharp_edges(square.soup, MeshAdjacency(square.soup), 100).size(), 4U);
  EXPECT_TRUE(few_sharp_edges(box.soup, MeshAdjacency(box.soup), 11).empty());
}

TEST(SkyBoundary, OfACourtIsTheTopOfItsWalls) {
  TestScene scene;
  scene.wall({0, 0, 10, 0}, 0, 5);
  scene.wall({10, 0, 10, 10}, 0, 5);
  scene.wall({10, 10, 0, 10}, 0, 5);
  scene.wall({0, 10, 0, 0}, 0, 5);
  const auto pieces = boundary(scene, {5, 5, 0});
  ASSERT_EQ(pieces.size(), 4U);
  // From the middle at half the height of its width an edge reaches over 2 atan(1 / sqrt 2).
  for (const BoundaryPiece& piece : pieces) {
    EXPECT_NEAR(length_deg(piece), 2.0 * std::atan(std::sqrt(0.5)) * 180.0 / kPi, 1e-9);
    EXPECT_NEAR(0.5 * (piece.a.z + piece.b.z), 5.0, 1e-12);
    EXPECT_GT(piece.outward.z, 0.0);
  }
}

TEST(SkyBoundary, OfASlabIsItsFourEdgesTurnedOutward) {
  TestScene scene;
  scene.level({-1, -1, 1, 1}, 2);
  const auto pieces = boundary(scene, {0, 0, 0});
  ASSERT_EQ(pieces.size(), 4U);
  for (const BoundaryPiece& piece : pieces) EXPECT_LT(piece.outward.z, 0.0);
}

TEST(SkyBoundary, IsCutWhereOneWallHidesAnother) {
  TestScene scene;
  scene.wall({-100, 20, 100, 20}, 0, 10);  // 26.6 degrees high in the north
  scene.begin_object();
  scene.wall({-1, 10, 1, 10}, 0, 20);  // before it, 63.4 degrees high and 11.4 degrees wide
  const auto pieces = boundary(scene, {0, 0, 0});
  // The tower's top and two sides from the wall up; the wall on both sides of the tower, and
  // its ends.
  TestScene wall;
  wall.wall({-100, 20, 100, 20}, 0, 10);
  const double hidden = 2.0 * std::atan(0.1 / std::hypot(1.0, 0.5));
  const double side =
      std::atan(20.0 / std::hypot(1.0, 10.0)) - std::atan(0.5 * 10.0 / std::hypot(1.0, 10.0));
  const double top = 2.0 * std::atan(1.0 / std::hypot(10.0, 20.0));
  EXPECT_NEAR(length_deg(pieces),
              length_deg(boundary(wall, {0, 0, 0})) + (2.0 * side + top - hidden) * 180.0 / kPi,
              1e-6);
}

TEST(SkyBoundary, LeavesOutWhatIsBelowTheHorizonOrBehindTheSurface) {
  TestScene scene;
  scene.wall({-100, 20, 100, 20}, -5, 10);
  EXPECT_EQ(boundary(scene, {0, 0, 0}, {0, -1, 0}).size(), 0U);
  for (const BoundaryPiece& piece : boundary(scene, {0, 0, 0}, {1, 0, 0})) {
    EXPECT_GE(piece.a.x, -1e-9);
    EXPECT_GE(piece.b.x, -1e-9);
    EXPECT_GE(std::min(piece.a.z, piece.b.z), -1e-9);
  }
}

TEST(SkyBoundary, OfASurfaceInPiecesIsThatOfTheWhole) {
  TestScene pieces, whole;
  whole.wall({-10, 5, 10, 5}, 0, 4);
  for (int k = 0; k < 4; ++k) {  // corners of one lie on edges of others
    pieces.wall({-10.0 + 5 * k, 5, -5.0 + 5 * k, 5}, k % 2 == 0 ? 0 : 1, 4);
    if (k % 2 != 0) pieces.wall({-10.0 + 5 * k, 5, -5.0 + 5 * k, 5}, 0, 1);
  }
  EXPECT_NEAR(length_deg(boundary(pieces, {1, 0, 0.5})), length_deg(boundary(whole, {1, 0, 0.5})),
              1e-6);
}

TEST(SkyBoundary, IsNotToldBehindGlass) {
  TestScene scene;
  Material pane;
  pane.name = "pane";
  pane.index = 1.52;
  scene.materials.push_back(pane);
  scene.level({-1, -1, 1, 1}, 2, 1);
  const RayVisibility rays(scene.soup, scene.materials);
  std::uint64_t sent = 0;
  EXPECT_FALSE(sky_boundary(rays, {0, 0, 0}, kZenith, sent));
}

}  // namespace
}  // namespace tenku
