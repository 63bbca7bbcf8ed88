// Regions of beams against single rays, followed in double precision by the test itself.
#include "beams/beam_tree.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/mirror_scene.h"

namespace tenku::testing_support {
namespace {

constexpr std::array<WindowPoint, 4> kWindow{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

BeamView eye_at(Vec3 eye, Vec3 forward) {
  const Vec3 across = normalized(cross(forward, kZenith));
  return BeamView::from_point(eye, forward, across, cross(across, forward));
}

bool has(const BeamFace& face, std::uint32_t triangle) {
  return std::find(face.triangles.begin(), face.triangles.end(), triangle) != face.triangles.end();
}

/// Compares the region at each of many places with the ray from there; the sum of the areas with
/// that of the window.
void expect_regions_of_rays(const MirrorScene& scene, const BeamView& view, int depth,
                            double reach = 1.0) {
  const BeamFaces faces = scene.faces();
  Progress progress;
  std::vector<WindowPoint> window;
  for (const WindowPoint p : kWindow) window.push_back({reach * p.u, reach * p.v});
  const BeamTree tree =
      trace_beams(faces, view, window, {.depth = depth, .slack = 1e-10}, progress);
  ASSERT_TRUE(tree.is_complete);
  double area = 0.0;
  for (const BeamRegion& region : tree.regions) area += area_of(region.corners);
  EXPECT_NEAR(area, 4.0 * reach * reach, 1e-8 * reach * reach);

  std::mt19937 chance(7);
  std::uniform_real_distribution<double> place(-reach, reach);
  int compared = 0;
  for (int k = 0; k < 400; ++k) {
    const WindowPoint p{place(chance), place(chance)};
    const BeamRegion* region = nullptr;
    bool is_at_border = false;
    for (const BeamRegion& r : tree.regions) {
      if (!is_inside(r, p, 1e-7)) continue;
      is_at_border = region != nullptr || !is_inside(r, p, -1e-7);
      region = &r;
    }
    ASSERT_NE(region, nullptr) << p.u << " " << p.v;
    if (is_at_border) continue;
    ++compared;
    const BeamRay ray = view.ray(p);
    const FollowedRay way = follow(scene, ray.origin, ray.direction, depth);
    const std::vector<std::uint32_t> chain = tree.chain(region->beam);
    ASSERT_EQ(chain.size(), way.mirrors.size()) << p.u << " " << p.v;
    for (std::size_t m = 0; m < chain.size(); ++m) {
      EXPECT_TRUE(has(faces[chain[m]], way.mirrors[m])) << p.u << " " << p.v;
    }
    ASSERT_EQ(region->end != kNoFace, way.end.has_value()) << p.u << " " << p.v;
    if (way.end) {
      EXPECT_TRUE(has(faces[region->end], *way.end)) << p.u << " " << p.v;
    }
    EXPECT_LT(length(tree.beams[region->beam].view.direction(p) - way.direction), 1e-11);
  }
  EXPECT_GT(compared, 300);
}

TEST(BeamTree, OneBoxOfMirrors) {
  MirrorScene scene;
  scene.box({-1, 4, -1}, {1, 6, 1}, 1);
  expect_regions_of_rays(scene, eye_at({0.7, 0, 1.6}, {0, 1, -0.3}), 3);
}

TEST(BeamTree, MirrorsBetweenAndBehindGreyBoxes) {
  std::mt19937 chance(3);
  std::uniform_real_distribution<double> place(-4, 4), side(0.3, 1.5);
  MirrorScene scene;
  for (std::uint32_t k = 0; k < 24; ++k) {
    const Vec3 low{place(chance), 8.0 + place(chance), place(chance)};
    scene.box(low, low + Vec3{side(chance), side(chance), side(chance)}, k % 2);
  }
  expect_regions_of_rays(scene, eye_at({0.1, -1, 0.2}, {0.02, 1, 0.03}), 4);
}

TEST(BeamTree, RectanglesThatCrossOneAnother) {
  std::mt19937 chance(11);
  std::uniform_real_distribution<double> place(-1, 1);
  const auto any = [&] { return Vec3{place(chance), place(chance), place(chance)}; };
  MirrorScene scene;
  for (std::uint32_t k = 0; k < 12; ++k) {
    const Vec3 a = normalized(any()), b = normalized(cross(a, any()));
    scene.rectangle(Vec3{0, 4, 0} + any(), a, b, k % 3 == 0 ? 0 : 1);
  }
  expect_regions_of_rays(scene, eye_at({0, 0, 0}, {0, 1, 0}), 4);
}

TEST(BeamTree, ParallelLightOntoMirrorsAndGround) {
  std::mt19937 chance(5);
  std::uniform_real_distribution<double> place(-4, 4);
  MirrorScene scene;
  scene.rectangle({0, 0, -2}, {20, 0, 0}, {0, 20, 0}, 0);
  for (int k = 0; k < 10; ++k) {
    const Vec3 low{place(chance), place(chance), -2.0};
    scene.box(low, low + Vec3{1.0, 1.2, 3.0}, 1);
  }
  const Vec3 light = normalized(Vec3{0.4, 0.5, -0.7});
  const Vec3 across = normalized(cross(light, kZenith));
  const BeamView sun = BeamView::along(light, {}, across, cross(across, light));
  expect_regions_of_rays(scene, sun, 4, 6.0);
}

TEST(BeamTree, MirrorMuchSmallerThanAnySampleIsFound) {
  MirrorScene scene;
  scene.rectangle({0.3, 5, 0.2}, {1e-4, 0, 0}, {0, 0, 1e-4}, 1);
  const BeamView view = eye_at({0, 0, 0}, {0, 1, 0});
  Progress progress;
  const BeamTree tree = trace_beams(scene.faces(), view, kWindow, {.slack = 1e-10}, progress);
  double area = 0.0;
  for (const BeamRegion& region : tree.regions) {
    if (tree.beams[region.beam].depth == 1) area += area_of(region.corners);
  }
  EXPECT_NEAR(area, 4e-8 / 25.0, 1e-13);  // its size by its distance squared
}

TEST(BeamTree, LightThrownByAFlatMirrorOntoFlatGround) {
  // A window of 2 x 3 m, 4 m over the ground; the sun behind the viewer. Each corner of the light
  // on the ground is where the mirrored sun's ray through the pane's corner comes down.
  MirrorScene scene;
  scene.rectangle({0, 10, 5.5}, {1, 0, 0}, {0, 0, 1.5}, 1);
  scene.rectangle({0, 0, 0}, {100, 0, 0}, {0, 100, 0}, 0);
  const Vec3 light = normalized(Vec3{0.3, 1.0, -0.8});
  const Vec3 across = normalized(cross(light, kZenith));
  const BeamView sun = BeamView::along(light, {}, across, cross(across, light));
  const BeamFaces faces = scene.faces();
  Progress progress;
  const std::array<WindowPoint, 4> window{{{-150, -150}, {150, -150}, {150, 150}, {-150, 150}}};
  const BeamTree tree = trace_beams(faces, sun, window, {.told_from = 1}, progress);
  std::vector<Vec3> corners;
  for (const BeamRegion& region : tree.regions) {
    if (region.end >= kUndivided) continue;
    EXPECT_EQ(tree.beams[region.beam].depth, 1);
    for (const Vec3 p : corners_on_face(tree, region, faces)) corners.push_back(p);
  }
  for (const double x : {-1.0, 1.0}) {
    for (const double z : {4.0, 7.0}) {
      const Vec3 expected{x + 0.3 * z / 0.8, 10.0 - 1.0 * z / 0.8, 0.0};
      double least = 1e9;
      for (const Vec3 p : corners) least = std::min(least, length(p - expected));
      EXPECT_LT(least, 1e-9);
    }
  }
}

TEST(BeamTree, TooManyRegionsAreToldAndNotMade) {
  MirrorScene scene;
  for (int k = 0; k < 20; ++k) scene.rectangle({-0.9 + 0.09 * k, 2, 0}, {0.03, 0, 0}, {0, 0, 1}, 1);
  Progress progress;
  const BeamTree tree =
      trace_beams(scene.faces(), eye_at({}, {0, 1, 0}), kWindow, {.most_regions = 10}, progress);
  EXPECT_FALSE(tree.is_complete);
}

TEST(BeamTree, WindowWithoutAreaIsRefused) {
  Progress progress;
  const std::array<WindowPoint, 3> flat{{{0, 0}, {1, 1}, {2, 2}}};
  const BeamFaces none = MirrorScene().faces();
  const BeamView view = eye_at({}, {0, 1, 0});
  EXPECT_THROW(trace_beams(none, view, flat, {}, progress), InputError);
  EXPECT_THROW(trace_beams(none, view, kWindow, {.depth = -1}, progress), InputError);
}

}  // namespace
}  // namespace tenku::testing_support
