// Faces of a scene, joined, and windows divided where rounding is hardest.
#include "beams/window_division.h"

#include <gtest/gtest.h>

#include "support/mirror_scene.h"

namespace tenku::testing_support {
namespace {

TEST(BeamFaces, TrianglesOfABoxAreItsSides) {
  MirrorScene scene;
  scene.box({0, 0, 0}, {1, 2, 3}, 1);
  const BeamFaces faces = scene.faces();
  ASSERT_EQ(faces.faces().size(), 6U);
  EXPECT_EQ(faces.mirrors(), 6U);
  for (const BeamFace& face : faces.faces()) EXPECT_EQ(face.corners.size(), 4U);
}

TEST(BeamFaces, StripOfPanesIsOneFaceAndPanesOfTwoMaterialsAreTwo) {
  MirrorScene scene;
  for (int k = 0; k < 7; ++k) scene.rectangle({2.0 * k, 0, 0}, {1, 0, 0}, {0, 0, 1}, 1);
  EXPECT_EQ(scene.faces().faces().size(), 1U);
  EXPECT_EQ(scene.faces()[0].corners.size(), 4U);
  scene.rectangle({14, 0, 0}, {1, 0, 0}, {0, 0, 1}, 0);
  EXPECT_EQ(scene.faces().faces().size(), 2U);
}

TEST(BeamFaces, ThreeSquaresInAnLAreNotOneFace) {
  MirrorScene scene;
  scene.rectangle({0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 1);
  scene.rectangle({2, 0, 0}, {1, 0, 0}, {0, 0, 1}, 1);
  scene.rectangle({0, 0, 2}, {1, 0, 0}, {0, 0, 1}, 1);
  EXPECT_EQ(scene.faces().faces().size(), 2U);
}

TEST(BeamFaces, PanesAtAThousandthOfADegreeAreNotOneFace) {
  MirrorScene scene;
  scene.rectangle({-1, 0, 0}, {1, 0, 0}, {0, 0, 1}, 1);
  const double turn = 1e-3 * kPi / 180.0;
  const Vec3 a{std::cos(turn), std::sin(turn), 0};
  scene.fan({{0, 0, -1}, 2.0 * a - kZenith, 2.0 * a + kZenith, {0, 0, 1}}, 1);
  EXPECT_EQ(scene.faces().faces().size(), 2U);
}

TEST(WindowDivision, OfTwoInOnePlaceTheMirrorIsTaken) {
  for (const std::uint32_t first : {0U, 1U}) {
    MirrorScene scene;
    scene.rectangle({0, 5, 0}, {4, 0, 0}, {0, 0, 4}, 0);
    if (first == 0) scene.soup = {};
    scene.rectangle({0.5, 5, 0.25}, {1, 0, 0}, {0, 0, 1}, 1);
    if (first == 0) scene.rectangle({0, 5, 0}, {4, 0, 0}, {0, 0, 4}, 0);
    const BeamFaces faces = scene.faces();
    const BeamView view = BeamView::from_point({}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1});
    const std::array<WindowPoint, 4> window{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    Progress progress;
    const BeamTree tree = trace_beams(faces, view, window, {}, progress);
    double mirrored = 0.0;
    for (const BeamRegion& region : tree.regions) {
      if (tree.beams[region.beam].depth == 1) mirrored += area_of(region.corners);
    }
    EXPECT_NEAR(mirrored, 4.0 / 25.0, 1e-9);
  }
}

}  // namespace
}  // namespace tenku::testing_support
