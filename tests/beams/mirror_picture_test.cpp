// Pictures of mirrors: beams against single rays, backgrounds, reflectances against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "beams/mirror_reflectance.h"
#include "core/error.h"
#include "support/measured.h"
#include "support/mirror_pictures.h"
#include "view/mirror_method.h"

namespace tenku::testing_support {
namespace {

/// A picture by a method, small enough for a test.
struct SmallPicture {
  MirrorPicture what;
  MirrorReport report;
  TracedPicture picture;

  SmallPicture(MirrorPicture of, MirrorMethod method, int side) : what(std::move(of)) {
    what.view.width = what.view.height = side;
    const RayVisibility rays(what.scene.soup, what.scene.materials);
    const CheckeredCube surroundings;
    const Backdrop backdrop{nullptr, {}, &surroundings};
    Progress progress;
    const auto paths = pixel_paths(PerspectiveCamera(what.view), rays, backdrop,
                                   {method, what.depth, true}, progress, report);
    picture = trace_picture(*paths, rays, what.view);
  }
};

TEST(MirrorPicture, BeamsShowWhatSingleRaysShow) {
  WorstError away("difference of beams and rays away from edges, by the range");
  WorstError differing("pixels at edges that differ, percent");
  for (const MirrorPicture& what : mirror_pictures()) {
    const SmallPicture beams(what, MirrorMethod::Beams, 160), rays(what, MirrorMethod::Rays, 160);
    ASSERT_EQ(beams.report.used, MirrorMethod::Beams) << what.name;
    const PictureDifference off = difference(beams.picture, rays.picture);
    away.add(off.away_from_edge, what.name);
    differing.add(100.0 * off.differing, what.name);
  }
  EXPECT_LT(away.worst(), 1e-4);
  EXPECT_LT(differing.worst(), 2.0);
}

TEST(MirrorPicture, BackgroundAloneAsksTheSceneNothing) {
  const SmallPicture beams(one_cuboid(), MirrorMethod::Beams, 64);
  const SmallPicture rays(one_cuboid(), MirrorMethod::Rays, 64);
  EXPECT_EQ(beams.picture.rays, 0U);
  EXPECT_GE(rays.picture.rays, 4U * 64U * 64U);
}

TEST(MirrorPicture, OfMirrorsThatAreOffNothingIsSeenButWhatTheyScatter) {
  const SmallPicture off(one_cuboid(), MirrorMethod::Off, 32);
  // The middle pixel is on the cuboid: a reflectance of 0.05 of the pattern, no background.
  EXPECT_LT(off.picture.image.at(16, 16).r, 0.05 * CheckeredCube::kRange);
  const SmallPicture on(one_cuboid(), MirrorMethod::Beams, 32);
  EXPECT_GT(on.picture.image.at(16, 16).r, 0.05 * CheckeredCube::kRange);
}

/// The one path through the middle of a picture of 1 x 1 pixels.
PixelPath middle_path(const MirrorScene& scene, const PerspectiveView& view, MirrorMethod method,
                      const MirrorOptions& options, const Backdrop& backdrop) {
  const RayVisibility rays(scene.soup, scene.materials);
  Progress progress;
  MirrorReport report;
  const auto paths = pixel_paths(PerspectiveCamera(view), rays, backdrop,
                                 {method, options.depth, true}, progress, report);
  PixelPath path;
  paths->follow(0, 0, 0, path);
  return path;
}

/// A narrow view, so that all rays of its pixel are all but one.
PerspectiveView narrow(Vec3 eye, Vec3 target) { return {eye, target, Angle::degrees(1e-3), 1, 1}; }

TEST(MirrorPicture, FacingMirrorsAtTheDepthLackAPowerOfTheReflectance) {
  MirrorScene scene;
  scene.rectangle({-1, 0, 0}, {0, 9, 0}, {0, 0, 9}, 1);
  scene.rectangle({1, 0, 0}, {0, 9, 0}, {0, 0, 9}, 1);
  const CheckeredCube surroundings;
  for (const MirrorMethod method : {MirrorMethod::Beams, MirrorMethod::Rays}) {
    for (const int depth : {0, 1, 5}) {
      const PixelPath path = middle_path(scene, narrow({0, 0, 0}, {1, 0.01, 0.02}), method,
                                         {method, depth, true}, {nullptr, {}, &surroundings});
      EXPECT_NEAR(path.cut_share, std::pow(0.8, depth + 1), 1e-12);
      ASSERT_EQ(path.points.size(), static_cast<std::size_t>(depth + 1));
      EXPECT_NEAR(path.points.back().weight.r, std::pow(0.8, depth), 1e-12);
      EXPECT_EQ(path.background, Rgb{});
    }
  }
}

TEST(MirrorPicture, TintIsMultipliedByEachMirror) {
  MirrorScene scene;
  scene.materials[1].mirror = luminance_of({0.5, 0.8, 0.9});
  scene.materials[1].mirror_tint = (1.0 / scene.materials[1].mirror) * Rgb{0.5, 0.8, 0.9};
  scene.rectangle({0, 4, 0}, {4, 4, 0}, {0, 0, 4}, 1);  // turns north into east
  scene.rectangle({6, 4, 0}, {4, 4, 0}, {0, 0, 4}, 1);  // and east into north again
  class Grey : public Background {
    Rgb colour(Vec3) const override { return Rgb::grey(100.0); }
  } const grey;
  for (const MirrorMethod method : {MirrorMethod::Beams, MirrorMethod::Rays}) {
    const PixelPath path = middle_path(scene, narrow({0, 0, 0}, {0, 1, 0}), method,
                                       {method, 4, true}, {nullptr, {}, &grey});
    EXPECT_NEAR(path.background.r, 25.0, 1e-9);
    EXPECT_NEAR(path.background.g, 64.0, 1e-9);
    EXPECT_NEAR(path.background.b, 81.0, 1e-9);
  }
}

TEST(MirrorPicture, FresnelReflectanceOfAPane) {
  // Both faces of a pane of index 1.52, the sum of the series 2 r / (1 + r) for either
  // polarisation: E. Hecht, Optics, eqs. 4.34 and 4.40 evaluated by hand at 0, at 60 degrees and at
  // Brewster's angle, at which p is not reflected.
  Material pane;
  pane.mirror_index = 1.52;
  const double face = std::pow(0.52 / 2.52, 2), upright = 2.0 * face / (1.0 + face);
  pane.mirror = upright;
  EXPECT_NEAR(mirror_reflectance(pane, 1.0).g, 0.08168, 1e-5);
  const auto both = [](double rs, double rp) { return rs / (1.0 + rs) + rp / (1.0 + rp); };
  const double inside = std::asin(std::sin(kPi / 3.0) / 1.52);
  const double s = std::sin(kPi / 3.0 - inside) / std::sin(kPi / 3.0 + inside),
               p = std::tan(kPi / 3.0 - inside) / std::tan(kPi / 3.0 + inside);
  EXPECT_NEAR(mirror_reflectance(pane, 0.5).g, both(s * s, p * p), 1e-12);
  const double brewster = std::atan(1.52);
  const double at_brewster = std::pow(std::cos(2.0 * brewster), 2);  // of s
  EXPECT_NEAR(mirror_reflectance(pane, std::cos(brewster)).g, both(at_brewster, 0.0), 1e-12);
  EXPECT_NEAR(mirror_reflectance(pane, 1e-9).g, 1.0, 1e-6);
}

TEST(CubeBackground, PicturesOfACameraAreSeenAgain) {
  // Six pictures of the checkered cube by cameras of 90 degrees, looked up in between.
  class Smooth : public Background {
   public:
    Rgb colour(Vec3 d) const override { return {1.0 + d.x, 2.0 + d.y, 3.0 + d.z}; }
  } const smooth;
  const std::array<Vec3, 6> towards{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  std::array<Image, 6> faces;
  constexpr int kSide = 256;
  for (std::size_t k = 0; k < 6; ++k) {
    const PerspectiveCamera camera({{}, towards[k], Angle::degrees(90.0), kSide, kSide});
    faces[k] = Image(kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x)
        faces[k].at(x, y) = smooth.colour(camera.ray(x + 0.5, y + 0.5));
    }
  }
  const CubeBackground cube(faces);
  double worst = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const double z = 2.0 * (k + 0.5) / 2000.0 - 1.0, turn = 2.399963 * k;
    const Vec3 d{std::sqrt(1.0 - z * z) * std::cos(turn), std::sqrt(1.0 - z * z) * std::sin(turn),
                 z};
    const Rgb a = cube.colour(d), b = smooth.colour(d);
    worst = std::max({worst, std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
  }
  EXPECT_LT(worst,
            0.0041);  // at most half a pixel, 1/256, by the slope of 1, beyond the last centre
  faces[2] = Image(4, 5);
  EXPECT_THROW(CubeBackground{faces}, InputError);
  EXPECT_THROW(read_background("cube:/no/such/folder", Luminance(1.0)), InputError);
  EXPECT_THROW(read_background("sphere:x", Luminance(1.0)), InputError);
}

TEST(MirrorMethod, NamesAndDepthsOutOfRangeAreRefused) {
  EXPECT_EQ(mirror_method_named("beams"), MirrorMethod::Beams);
  EXPECT_THROW(mirror_method_named("beam"), InputError);
  EXPECT_THROW(check_mirror_depth(-1), InputError);
  EXPECT_THROW(check_mirror_depth(65), InputError);
  check_mirror_depth(64);
}

// Where methods are known to fail.

TEST(MirrorPicture, MirrorSeenEdgeOnOrWithTheEyeInItsPlaneIsNotThere) {
  MirrorPicture what{"edge-on", {}, {{0, -4, 0}, {0, 0, 0}, Angle::degrees(50.0), 1, 1}, 4};
  what.scene.rectangle({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1);
  const SmallPicture beams(what, MirrorMethod::Beams, 65), rays(what, MirrorMethod::Rays, 65);
  EXPECT_EQ(beams.report.regions, 1U);
  EXPECT_EQ(difference(beams.picture, rays.picture).away_from_edge, 0.0);
  // Looking along the mirror from within it.
  what.view.eye = {0, -0.5, 0.1};
  const SmallPicture within(what, MirrorMethod::Beams, 65);
  for (const Rgb& pixel : within.picture.image.pixels) EXPECT_TRUE(std::isfinite(pixel.r));
}

TEST(MirrorPicture, MirrorSeenAtAGlanceShowsWhatRaysShow) {
  for (const double off : {1e-2, 1e-3, 1e-4}) {
    MirrorPicture what{"at a glance", {}, {{off, -4, 0}, {0, 0, 0}, Angle::degrees(2.0), 1, 1}, 4};
    what.scene.rectangle({0, 0, 0}, {0, 3.9, 0}, {0, 0, 1}, 1);
    what.scene.box({0.2, 2, -1}, {0.6, 2.5, 1}, 0);
    const SmallPicture beams(what, MirrorMethod::Beams, 128), rays(what, MirrorMethod::Rays, 128);
    const PictureDifference difference_found = difference(beams.picture, rays.picture);
    EXPECT_LT(difference_found.away_from_edge, 1e-4) << off;
    EXPECT_LT(difference_found.differing, 0.02) << off;
  }
}

TEST(MirrorPicture, PanesThatMeetAtTheMiddleOfAnEdgeLeaveNoGap) {
  // A row of three over a row of two: each joint of one row ends on an edge of the other.
  MirrorPicture what{"T", {}, {{0.3, -5, 0.4}, {0, 0, 0}, Angle::degrees(40.0), 1, 1}, 2};
  for (int k = 0; k < 3; ++k) {
    what.scene.fan({{-1.5 + k, 0, 0}, {-0.5 + k, 0, 0}, {-0.5 + k, 0, 1}, {-1.5 + k, 0, 1}}, 1);
  }
  for (int k = 0; k < 2; ++k) {
    const double x = -1.5 + 1.5 * k;
    what.scene.fan({{x, 0, -1}, {x + 1.5, 0, -1}, {x + 1.5, 0, 0}, {x, 0, 0}}, 1);
  }
  const SmallPicture beams(what, MirrorMethod::Beams, 128);
  MirrorPicture whole = what;
  whole.scene.soup = {};
  whole.scene.fan({{-1.5, 0, -1}, {1.5, 0, -1}, {1.5, 0, 1}, {-1.5, 0, 1}}, 1);
  const SmallPicture one(whole, MirrorMethod::Beams, 128);
  for (std::size_t p = 0; p < one.picture.image.pixels.size(); ++p) {
    EXPECT_NEAR(beams.picture.image.pixels[p].r, one.picture.image.pixels[p].r, 1e-6);
  }
}

TEST(MirrorPicture, FacadeOfTenThousandScatteredPanesFallsBackToRaysAndSaysSo) {
  const MirrorPicture what = scattered_facade();
  const SmallPicture chosen(what, MirrorMethod::Auto, 128);
  EXPECT_EQ(chosen.report.used, MirrorMethod::Rays);
  ASSERT_EQ(chosen.report.findings.size(), 1U);
  EXPECT_EQ(chosen.report.findings[0].code, "mirrors_by_rays");
  // Asked for, beams do it all the same.
  const SmallPicture beams(what, MirrorMethod::Beams, 128);
  EXPECT_EQ(beams.report.used, MirrorMethod::Beams);
  EXPECT_LT(difference(beams.picture, chosen.picture).away_from_edge, 1e-4);
}

TEST(MirrorPicture, FacetsOfBentGlassComeCloserToTheCylinderTheMoreThereAre) {
  // A mirror in the shape of an upright cylinder, seen from inside off its axis: what it shows is
  // found by the cylinder's own normal. The direction is off by up to the angle of half a facet,
  // twice; it falls as one over the number of facets.
  double before = 0.0;
  for (const int facets : {8, 32, 128}) {
    const MirrorPicture what = bent_glass(facets, 1);
    const RayVisibility rays(what.scene.soup, what.scene.materials);
    const CheckeredCube surroundings;
    Progress progress;
    const std::array<WindowPoint, 4> window{{{0, 0}, {1024, 0}, {1024, 300}, {0, 300}}};
    const PerspectiveCamera camera(what.view);
    const BeamTree tree =
        trace_beams(what.scene.faces(), camera.window(), window, {.depth = 1}, progress);
    double worst = 0.0;
    for (const BeamRegion& region : tree.regions) {
      if (tree.beams[region.beam].depth != 1) continue;
      for (const WindowPoint p : region.corners) {
        const Vec3 d = normalized(camera.window().direction(p)), e = camera.eye();
        const double a = d.x * d.x + d.y * d.y, b = e.x * d.x + e.y * d.y,
                     c = e.x * e.x + e.y * e.y - 16.0;
        const Vec3 at = e + (-b + std::sqrt(b * b - a * c)) / a * d;
        const Vec3 n = normalized(Vec3{at.x, at.y, 0});
        const Vec3 exact = d - 2.0 * dot(d, n) * n;
        worst = std::max(
            worst, angle_between(tree.beams[region.beam].view.direction(p), exact).in_radians());
      }
    }
    EXPECT_LT(worst, 1.05 * 0.8 * kPi / facets);  // the angle of one facet: half of it, twice
    if (before > 0.0) {
      EXPECT_NEAR(before / worst, 4.0, 0.5);
    }
    before = worst;
  }
}

}  // namespace
}  // namespace tenku::testing_support
