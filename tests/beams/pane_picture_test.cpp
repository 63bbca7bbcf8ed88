// Panes that mirror and are looked through in pictures: beams against single rays, and both against
// Fresnel's formulas evaluated here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/measured.h"
#include "support/mirror_pictures.h"
#include "view/mirror_method.h"

namespace tenku::testing_support {
namespace {

struct Traced {
  MirrorReport report;
  TracedPicture picture;
};

Traced traced(MirrorPicture what, MirrorMethod method, int side) {
  what.view.width = what.view.height = side;
  const RayVisibility rays(what.scene.soup, what.scene.materials);
  const CheckeredCube surroundings;
  const Backdrop backdrop{nullptr, {}, &surroundings};
  Progress progress;
  Traced made;
  const auto paths = pixel_paths(PerspectiveCamera(what.view), rays, backdrop,
                                 {method, what.depth, true}, progress, made.report);
  made.picture = trace_picture(*paths, rays, what.view);
  return made;
}

PixelPath middle_path(const MirrorScene& scene, Vec3 eye, Vec3 target, MirrorMethod method,
                      int depth, const Background& around) {
  const RayVisibility rays(scene.soup, scene.materials);
  const Backdrop backdrop{nullptr, {}, &around};
  const PerspectiveView narrow{eye, target, Angle::degrees(1e-5), 1, 1};
  Progress progress;
  MirrorReport report;
  const auto paths = pixel_paths(PerspectiveCamera(narrow), rays, backdrop, {method, depth, true},
                                 progress, report);
  PixelPath path;
  paths->follow(0, 0, 0, path);
  return path;
}

/// Behind x = 0 red, before it green: what is seen through and what is mirrored.
class TwoHalves : public Background {
  Rgb colour(Vec3 d) const override { return d.x > 0.0 ? Rgb{100.0, 0, 0} : Rgb{0, 100.0, 0}; }
};

/// Reflectance of both faces of a pane of glass: 2 r / (1 + r) for either polarisation, r by
/// Fresnel's sine and tangent laws (E. Hecht, Optics, eqs. 4.42 and 4.43).
double pane_by_fresnel(double incidence, double index) {
  const double inside = std::asin(std::sin(incidence) / index);
  const double s = std::sin(incidence - inside) / std::sin(incidence + inside),
               p = std::tan(incidence - inside) / std::tan(incidence + inside);
  const auto both = [](double r) { return 2.0 * r / (1.0 + r); };
  return 0.5 * (both(s * s) + both(p * p));
}

TEST(PanePicture, MirrorsAndIsLookedThroughByFresnel) {
  MirrorScene scene = scene_with_pane();
  scene.rectangle({0, 0, 0}, {0, 50, 0}, {0, 0, 50}, kPane);
  const TwoHalves around;
  for (const MirrorMethod method : {MirrorMethod::Beams, MirrorMethod::Rays}) {
    for (const double degrees : {10.0, 45.0, 56.66, 75.0, 85.0}) {
      const double angle = degrees * kPi / 180.0;
      const Vec3 eye{-std::cos(angle), -std::sin(angle), 0.01};
      const PixelPath path = middle_path(scene, eye, {0, 0, 0.01}, method, 4, around);
      const double mirrored = pane_by_fresnel(angle, 1.52);
      // The ray is off the middle of the view by 4e-6 degrees; at 85 R grows by 4.6 % a degree.
      EXPECT_NEAR(path.background.g, 100.0 * mirrored, 1e-4) << degrees;
      EXPECT_NEAR(path.background.r, 100.0 * (1.0 - mirrored), 1e-4) << degrees;
    }
  }
}

TEST(PanePicture, ClearPaneBeforeAUniformSkyIsNotSeen) {
  MirrorScene scene = scene_with_pane(1.9);
  scene.rectangle({0, 0, 0}, {0, 5, 0}, {0, 0, 5}, kPane);
  class Uniform : public Background {
    Rgb colour(Vec3) const override { return Rgb::grey(5000.0); }
  } const sky;
  for (const MirrorMethod method : {MirrorMethod::Beams, MirrorMethod::Rays}) {
    for (const double y : {-0.1, -1.0, -4.0, -20.0}) {
      const PixelPath path = middle_path(scene, {-1, y, 0}, {0, 0.01, 0.02}, method, 1, sky);
      EXPECT_NEAR(path.background.g, 5000.0, 1e-9 * 5000.0);
    }
  }
}

TEST(PanePicture, AbsorbingPaneMirrorsLikeFloatGlass) {
  // Transmittance 0.6 upright: what is mirrored is that of clear glass, the rest stays inside.
  MirrorScene scene = scene_with_pane(0.0);
  scene.materials[kPane].transmittance = 0.6;
  scene.rectangle({0, 0, 0}, {0, 5, 0}, {0, 0, 5}, kPane);
  const TwoHalves around;
  const double face = std::pow(0.52 / 2.52, 2);
  for (const MirrorMethod method : {MirrorMethod::Beams, MirrorMethod::Rays}) {
    const PixelPath path = middle_path(scene, {-1, 0.1, 0.1}, {0, 0.1, 0.1}, method, 1, around);
    EXPECT_NEAR(path.background.g, 100.0 * 2.0 * face / (1.0 + face), 1e-6);
    EXPECT_NEAR(path.background.r, 60.0, 1e-6);
  }
}

TEST(PanePicture, TwoPanesInARowMirrorAsTheSeriesSays) {
  // Between parallel panes the light goes to and fro: R + T^2 R (1 + R^2 + ...) comes back, cut off
  // where the depth is.
  MirrorScene scene = scene_with_pane();
  scene.rectangle({0, 0, 0}, {0, 5, 0}, {0, 0, 5}, kPane);
  scene.rectangle({0.1, 0, 0}, {0, 5, 0}, {0, 0, 5}, kPane);
  const TwoHalves around;
  const double face = std::pow(0.52 / 2.52, 2), r = 2.0 * face / (1.0 + face), t = 1.0 - r;
  for (const MirrorMethod method : {MirrorMethod::Beams, MirrorMethod::Rays}) {
    const auto at = [&](int depth) {
      return middle_path(scene, {-1, 0.1, 0.1}, {0, 0.1, 0.1}, method, depth, around);
    };
    EXPECT_NEAR(at(0).background.r, 100.0 * t * t, 1e-6);
    EXPECT_NEAR(at(0).background.g, 0.0, 1e-12);
    EXPECT_NEAR(at(0).cut_share, r + t * r, 1e-8);
    EXPECT_NEAR(at(1).background.g, 100.0 * (r + t * t * r), 1e-6);
    EXPECT_NEAR(at(2).background.r, 100.0 * t * t * (1.0 + r * r), 1e-6);
    EXPECT_NEAR(at(3).background.g, 100.0 * (r + t * t * r * (1.0 + r * r)), 1e-6);
  }
}

MirrorPicture with_eye(Vec3 eye, Vec3 target) {
  MirrorPicture made = glass_house();
  made.view.eye = eye;
  made.view.target = target;
  return made;
}

double off_by(Rgb p, Rgb q) {
  return std::max({std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)}) /
         CheckeredCube::kRange;
}

/// Largest difference where single rays show the same when the eye moves by 1e-5 m (level, so that
/// it stays in a pane's plane): elsewhere a ray passes so near to an edge, maybe after several
/// mirrors, that rounding decides.
double off_away_from_edges(const Traced& beams, const MirrorPicture& what, int side) {
  const auto from = [&](Vec3 moved) {
    MirrorPicture other = what;
    other.view.eye = what.view.eye + moved;
    other.view.target = what.view.target + moved;
    return traced(other, MirrorMethod::Rays, side).picture.image.pixels;
  };
  constexpr double kMoved = 1e-5;
  const auto here = from({}), aside = from({kMoved, 0.0, kMoved}),
             back = from({-kMoved, 0.0, -kMoved});
  double worst = 0.0;
  std::size_t unsure = 0;
  for (std::size_t k = 0; k < here.size(); ++k) {
    if (std::max(off_by(here[k], aside[k]), off_by(here[k], back[k])) > 1e-4) {
      ++unsure;
    } else {
      worst = std::max(worst, off_by(here[k], beams.picture.image.pixels[k]));
    }
  }
  EXPECT_LT(static_cast<double>(unsure), 0.01 * static_cast<double>(here.size()));
  return worst;
}

TEST(PanePicture, BeamsShowWhatSingleRaysShow) {
  constexpr int kSide = 64;
  std::vector<MirrorPicture> pictures{glass_house(),
                                      with_eye({-1.0, -0.9, 1.3}, {1, 1, 0.9}),   // inside
                                      with_eye({1.9, -0.6, 1.2}, {0, 0, 1}),      // between panes
                                      with_eye({0.2, -1.2, 1.2}, {0.3, 2, 0.9}),  // in a pane
                                      with_eye({4, -1.2, 1.0}, {-2, -1.19, 1})};  // in its plane
  for (MirrorPicture what : pictures) {
    const Traced beams = traced(what, MirrorMethod::Beams, kSide),
                 rays = traced(what, MirrorMethod::Rays, kSide);
    ASSERT_EQ(beams.report.used, MirrorMethod::Beams);
    const PictureDifference off = difference(beams.picture, rays.picture);
    EXPECT_LT(off_away_from_edges(beams, what, kSide), 1e-4) << what.view.eye.x;
    EXPECT_LT(100.0 * off.differing, 2.0) << what.view.eye.x;
    double mirrored = 0.0;
    what.depth = 0;
    const Traced through = traced(what, MirrorMethod::Beams, kSide);
    for (std::size_t k = 0; k < through.picture.image.pixels.size(); ++k) {
      mirrored =
          std::max(mirrored, beams.picture.image.pixels[k].g - through.picture.image.pixels[k].g);
    }
    EXPECT_GT(mirrored, 0.02 * CheckeredCube::kRange);
  }
}

TEST(PanePicture, PaneInThePlaneOfAWallMirrorsAndTheWallIsSeenBehindIt) {
  MirrorScene scene = scene_with_pane();
  scene.rectangle({0, 0, 0}, {0, 9, 0}, {0, 0, 9}, 0);
  scene.rectangle({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, kPane);
  const TwoHalves around;
  const double face = std::pow(0.52 / 2.52, 2), r = 2.0 * face / (1.0 + face);
  for (const MirrorMethod method : {MirrorMethod::Beams, MirrorMethod::Rays}) {
    const PixelPath path = middle_path(scene, {-4, 0.1, 0.1}, {0, 0.1, 0.1}, method, 2, around);
    EXPECT_NEAR(path.background.g, 100.0 * r, 1e-6);
    ASSERT_EQ(path.points.size(), 1U);
    EXPECT_NEAR(path.points[0].weight.g, 1.0 - r, 1e-8);
    EXPECT_NEAR(path.points[0].position.x, 0.0, 1e-9);
  }
}

TEST(PanePicture, ManyPanesInARowEndAndAreTold) {
  MirrorScene scene = scene_with_pane();
  for (int k = 0; k < 60; ++k) {
    scene.rectangle({0.1 * k, 0, 0}, {0, 5, 0}, {0, 0, 5}, kPane);
  }
  const TwoHalves around;
  const double face = std::pow(0.52 / 2.52, 2), r = 2.0 * face / (1.0 + face);
  for (const MirrorMethod method : {MirrorMethod::Beams, MirrorMethod::Rays}) {
    // Straight through all of them; of the last 28 none mirrors, and what they would is told.
    const PixelPath path = middle_path(scene, {-1, 0.1, 0.1}, {0, 0.1, 0.1}, method, 1, around);
    EXPECT_NEAR(path.background.r, 100.0 * std::pow(1.0 - r, 60), 1e-6);
    EXPECT_GT(path.cut_share, std::pow(1.0 - r, 32) - std::pow(1.0 - r, 60));
    double back = 0.0;
    for (int k = 0; 2 * k + 1 <= 32 + 1000; ++k) {
      const double there = std::pow(1.0 - r, k);
      if (k >= 32 || there * r < 1e-4) break;
      back += 100.0 * there * r * std::pow(1.0 - r, k);
    }
    EXPECT_NEAR(path.background.g, back, 1e-6);
  }
}

}  // namespace
}  // namespace tenku::testing_support
