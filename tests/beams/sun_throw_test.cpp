// Sunlight thrown by mirrors, against closed forms and against rays.
#include "beams/sun_throw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "beams/first_met.h"
#include "beams/sun_overlaps.h"
#include "core/random.h"
#include "support/test_scene.h"

namespace tenku {
namespace {

using testing_support::TestScene;

constexpr double kNormalLux = 80000.0;

Material mirror_of(double share) {
  Material material;
  material.mirror = share;
  return material;
}

Material glass_of(double index) {
  Material material;
  material.index = index;
  return material;
}

/// A scene with all that throwing takes. Material 0 is black, 1 and on are the given ones.
struct Bench {
  TestScene scene;

  explicit Bench(const std::vector<Material>& materials) {
    scene.materials.insert(scene.materials.end(), materials.begin(), materials.end());
  }

  ThrownSun thrown(Vec3 sun, const ThrowOptions& options = {}) {
    tree = std::make_unique<TriangleTree>(scene.soup);
    const MeshAdjacency adjacency(scene.soup);
    panels = mirror_panels(scene.soup, scene.materials, adjacency);
    return throw_sunlight(*tree, scene.materials, panels,
                          {sun, Angle::degrees(0.2665), Illuminance(kNormalLux)}, options, {});
  }

  std::unique_ptr<TriangleTree> tree;
  std::vector<MirrorPanel> panels;
};

Vec3 sun_at_degrees(double azimuth, double altitude) {
  return direction_from(Angle::degrees(azimuth), Angle::degrees(altitude));
}

Vec3 mirrored(Vec3 d, Vec3 n) { return d - 2.0 * dot(d, n) * n; }

double distance_to_nearest_corner(const ThrownSun& thrown, Vec3 p) {
  double nearest = 1e300;
  for (const ThrownPolygon& polygon : thrown.polygons) {
    for (const Vec3& corner : polygon.corners) nearest = std::min(nearest, length(corner - p));
  }
  return nearest;
}

double lumen_of(const ThrownSun& thrown) {
  double lumen = 0.0;
  for (const ThrownPolygon& p : thrown.polygons) lumen += p.lux * p.area_m2;
  return lumen;
}

/// Whether a point of its plane lies in a flat convex polygon, counter-clockwise about `normal`.
bool holds(const std::vector<Vec3>& corners, Vec3 normal, Vec3 p) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 a = corners[k], b = corners[(k + 1) % corners.size()];
    if (dot(cross(b - a, p - a), normal) < 0.0) return false;
  }
  return true;
}

TEST(SunThrow, AFlatMirrorOverFlatGroundHasTheCornersOfTheClosedForm) {
  Bench bench({mirror_of(1.0)});
  bench.scene.level({-500, -500, 500, 500}, 0.0);
  bench.scene.begin_object();
  bench.scene.wall({-1, 0, 1, 0}, 2.0, 5.0, 1);  // faces south
  for (const double azimuth : {100.0, 150.0, 180.0, 245.0}) {
    for (const double altitude : {5.0, 40.0, 75.0}) {
      const Vec3 sun = sun_at_degrees(azimuth, altitude);
      const ThrownSun thrown = bench.thrown(sun);
      // Mirrored in the plane y = 0: x goes on as it came, y turns back.
      const Vec3 away{-sun.x, sun.y, -sun.z};
      for (const Vec3 corner : {Vec3{-1, 0, 2}, {1, 0, 2}, {1, 0, 5}, {-1, 0, 5}}) {
        const Vec3 at = corner + (corner.z / sun.z) * away;
        EXPECT_LT(distance_to_nearest_corner(thrown, at), 1e-6) << azimuth << " " << altitude;
      }
      const double across = 6.0 * std::abs(sun.y);  // of the light that the mirror takes
      double area = 0.0;
      for (const ThrownPolygon& p : thrown.polygons) {
        area += p.area_m2;
        EXPECT_NEAR(p.lux, kNormalLux * sun.z, 1e-6);
        EXPECT_GT(cross(p.corners[1] - p.corners[0], p.corners[2] - p.corners[1]).z, 0.0);
      }
      EXPECT_NEAR(area, across / sun.z, 1e-6 * across / sun.z);
      EXPECT_NEAR(thrown.panels[0].arriving_lm, kNormalLux * across, 1e-6 * kNormalLux * across);
    }
  }
}

TEST(SunThrow, FluxIsThatOnTheMirrorTimesItsReflectanceTimesTheUnobstructedPart) {
  Bench bench({mirror_of(0.6)});
  bench.scene.level({-100, -100, 100, 100}, 0.0);
  bench.scene.begin_object();
  bench.scene.wall({-1, 0, 1, 0}, 0.0, 4.0, 1);
  bench.scene.begin_object();
  bench.scene.wall({-50, -2, 50, -2}, 0.0, 4.0);
  const double altitude = 30.0;
  const Vec3 sun = sun_at_degrees(180.0, altitude);
  const ThrownSun thrown = bench.thrown(sun);
  // The wall 2 m before it hides the mirror up to 4 m - 2 m tan(30 deg).
  const double open = 2.0 * std::tan(altitude * kPi / 180.0) / 4.0;
  const double on_mirror = kNormalLux * 8.0 * std::cos(altitude * kPi / 180.0);
  const double share = 0.6;
  EXPECT_NEAR(thrown.panels[0].lit_lm / thrown.panels[0].arriving_lm, open, 1e-9);
  EXPECT_NEAR(lumen_of(thrown), on_mirror * share * open, 1e-3 * on_mirror * share * open);
  EXPECT_NEAR(lumen_of(thrown), on_mirror * share * open, 1e-6);  // it is exact, in fact
  EXPECT_NEAR(thrown.landed_lm + thrown.sky_lm, thrown.started_lm, 1e-6);
}

TEST(SunThrow, AParabolicFacadeGivesItsFocusTheLightOfAllItsFacets) {
  // Facets tangent in plan to y = x^2 / 4f, the sun due north: by the parabola's definition the
  // mid-rays of all facets meet in the focus, after a level way as long as that to the directrix.
  constexpr double kFocal = 12.0, kWidth = 1.0, kHeight = 40.0, kAltitude = 35.0;
  constexpr int kFacets = 9;
  Bench bench({mirror_of(1.0)});
  bench.scene.level({-100, -100, 100, 100}, 0.0);
  for (int k = 0; k < kFacets; ++k) {
    const double x = (k - kFacets / 2) * 1.6, slope = x / (2.0 * kFocal);
    const double half = 0.5 * kWidth / std::hypot(1.0, slope), y = x * x / (4.0 * kFocal);
    bench.scene.begin_object();
    bench.scene.wall({x + half, y + slope * half, x - half, y - slope * half}, 0.0, kHeight, 1);
    ASSERT_GT(kHeight, (kFocal + y) * std::tan(kAltitude * kPi / 180.0));
  }
  const Vec3 sun = sun_at_degrees(0.0, kAltitude);
  const ThrownSun thrown = bench.thrown(sun, {.depth = 1});
  double lux = 0.0;
  std::set<std::uint32_t> panels;
  const Vec3 focus{0.0, kFocal, 0.0};
  const std::vector<SunPatch> patches = added_up(bench.scene.soup, thrown.polygons);
  for (const SunPatch& patch : patches) {
    if (std::abs(patch.corners[0].z) > 1e-9 || !holds(patch.corners, kZenith, focus)) continue;
    lux = patch.lux;
    panels.insert(patch.panels.begin(), patch.panels.end());
  }
  EXPECT_EQ(panels.size(), kFacets);
  EXPECT_NEAR(lux, kFacets * kNormalLux * sun.z, 1e-3);
  double added = 0.0;
  for (const SunPatch& patch : patches) added += patch.lux * patch.area_m2;
  EXPECT_NEAR(added, lumen_of(thrown), 1e-8 * added);
}

/// Walls and mirrors at random, some through one another.
Bench random_scene(std::uint64_t seed) {
  Bench bench({mirror_of(0.9), glass_of(1.52)});
  SampleRandom random(seed, 0, 0);
  bench.scene.level({-60, -60, 60, 60}, 0.0);
  for (int k = 0; k < 60; ++k) {
    bench.scene.begin_object();
    const double x = 40.0 * random.uniform() - 20.0, y = 40.0 * random.uniform() - 20.0;
    const double turn = 2.0 * kPi * random.uniform(), far = 1.0 + 6.0 * random.uniform();
    const double low = 6.0 * random.uniform();
    bench.scene.wall({x, y, x + far * std::cos(turn), y + far * std::sin(turn)}, low,
                     low + 1.0 + 5.0 * random.uniform(), k % 3 == 0 ? 1 : 0);
  }
  return bench;
}

TEST(SunThrow, PolygonsLieWhereRaysMeetTheScene) {
  int asked = 0, agreed = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Bench bench = random_scene(seed);
    const Vec3 sun = sun_at_degrees(40.0 + 60.0 * static_cast<double>(seed), 35.0);
    const ThrownSun thrown = bench.thrown(sun, {.depth = 1});
    const RayVisibility rays(bench.scene.soup, bench.scene.materials);
    SampleRandom random(seed, 1, 0);
    for (std::uint32_t p = 0; p < bench.panels.size(); ++p) {
      const MirrorPart& part = bench.panels[p].parts[0];
      const Vec3 n = dot(part.normal, sun) > 0.0 ? part.normal : -part.normal;
      for (int k = 0; k < 200; ++k) {
        const Vec3 at = part.corners[0] + random.uniform() * (part.corners[1] - part.corners[0]) +
                        random.uniform() * (part.corners[3] - part.corners[0]);
        const Vec3 from = at + 1e-4 * n;
        const auto hit =
            rays.is_occluded(from, sun) ? std::nullopt : rays.first_hit(from, mirrored(-sun, n));
        const Vec3 where = hit ? from + hit->distance_m * mirrored(-sun, n) : Vec3{};
        const bool is_told =
            hit &&
            std::any_of(
                thrown.polygons.begin(), thrown.polygons.end(), [&](const ThrownPolygon& q) {
                  const Vec3 up = cross(q.corners[1] - q.corners[0], q.corners[2] - q.corners[0]);
                  return q.panel == p && q.triangle == hit->triangle && holds(q.corners, up, where);
                });
        if (!hit) continue;
        ++asked;
        agreed += is_told ? 1 : 0;
      }
    }
  }
  EXPECT_GT(asked, 4000);
  // A ray may pass an edge on the other side of it than its point, which is lifted 0.1 mm.
  EXPECT_GT(agreed, asked - asked / 1000);
}

TEST(SunThrow, LightIsKeptThroughEveryMirrorAndItsShareOfThePanelIsThatOfRays) {
  for (std::uint64_t seed = 11; seed <= 14; ++seed) {
    Bench bench = random_scene(seed);
    const Vec3 sun = sun_at_degrees(70.0 * static_cast<double>(seed), 25.0);
    const ThrownSun thrown = bench.thrown(sun, {.depth = 4});
    EXPECT_GT(thrown.started_lm, 0.0);
    EXPECT_NEAR(thrown.landed_lm + thrown.sky_lm, thrown.started_lm, 1e-6 * thrown.started_lm);
    EXPECT_NEAR(lumen_of(thrown), thrown.landed_lm, 1e-6 * thrown.landed_lm);
    const RayVisibility rays(bench.scene.soup, bench.scene.materials);
    double seen = 0.0, lit = 0.0, arriving = 0.0;
    for (std::uint32_t p = 0; p < bench.panels.size(); ++p) {
      const MirrorPart& part = bench.panels[p].parts[0];
      const Vec3 n = dot(part.normal, sun) > 0.0 ? part.normal : -part.normal;
      SampleRandom random(seed, 2, p);
      int open = 0;
      constexpr int kSide = 120;
      for (int k = 0; k < kSide * kSide; ++k) {
        const Vec3 at =
            part.corners[0] +
            ((k % kSide + random.uniform()) / kSide) * (part.corners[1] - part.corners[0]) +
            ((k / kSide + random.uniform()) / kSide) * (part.corners[3] - part.corners[0]);
        open += rays.is_occluded(at + 1e-4 * n, sun) ? 0 : 1;
      }
      arriving += thrown.panels[p].arriving_lm;
      lit += thrown.panels[p].lit_lm;
      seen += thrown.panels[p].arriving_lm * open / (kSide * kSide);
    }
    // One ray in each of 14,400 equal cells: the edge of a shadow crosses some 120 of them, each
    // with a variance of a quarter at most. Mean of 20 panels: 1e-3 is ten standard errors.
    EXPECT_NEAR(lit / arriving, seen / arriving, 1e-3);
  }
}

ThrownPolygon square(std::uint32_t panel, double west, double lux) {
  ThrownPolygon p;
  p.panel = panel;
  p.lux = lux;
  p.area_m2 = 4.0;
  p.corners = {{west, -1, 0}, {west + 2, -1, 0}, {west + 2, 1, 0}, {west, 1, 0}};
  return p;
}

TEST(SunThrow, OverlappingPolygonsAddUpAndThoseOnTheOtherSideDoNot) {
  TestScene scene;
  scene.soup.vertices = {{-50, -50, 0}, {50, -50, 0}, {0, 90, 0}};
  scene.soup.triangles = {{0, 1, 2}};
  ThrownPolygon below = square(3, 0.0, 7.0);
  std::reverse(below.corners.begin(), below.corners.end());
  const std::vector<SunPatch> patches = added_up(
      scene.soup, {square(0, 0.0, 100.0), square(1, 1.0, 50.0), square(2, 1.5, 20.0), below});
  std::map<double, double> area;  // of each sum of lux
  for (const SunPatch& patch : patches) area[patch.lux] += patch.area_m2;
  const std::map<double, double> expected{{100.0, 2.0}, {150.0, 1.0}, {170.0, 1.0},
                                          {70.0, 2.0},  {20.0, 1.0},  {7.0, 4.0}};
  ASSERT_EQ(area.size(), expected.size());
  for (const auto& [lux, m2] : expected) EXPECT_NEAR(area[lux], m2, 1e-9) << lux;
}

TEST(SunThrow, FacingMirrorsAreFollowedToTheDepthAndTheRestIsTold) {
  Bench bench({mirror_of(0.5)});
  bench.scene.begin_object();
  bench.scene.wall({-10, 0, 10, 0}, 0.0, 30.0, 1);
  bench.scene.begin_object();
  bench.scene.wall({10, -3, -10, -3}, 0.0, 10.0, 1);
  bench.scene.begin_object();
  bench.scene.level({-100, -100, 100, 100}, 0.0);
  const Vec3 sun = sun_at_degrees(180.0, 50.0);
  const double share = 0.5;
  double before = 1e300;
  for (unsigned depth = 1; depth <= 5; ++depth) {
    const ThrownSun thrown = bench.thrown(sun, {.depth = depth, .least_lux = 0.0});
    // Of one beam in at most `depth` mirrors: what is left is at most what came, by their shares.
    EXPECT_LE(thrown.unfollowed_lm,
              1.000001 * thrown.panels[0].lit_lm * std::pow(share, depth + 1) +
                  1.000001 * thrown.panels[1].lit_lm * std::pow(share, depth + 1));
    EXPECT_LE(thrown.unfollowed_lm, before);
    before = thrown.unfollowed_lm;
    for (const ThrownPolygon& p : thrown.polygons) EXPECT_LE(p.mirrors, depth);
  }
  EXPECT_EQ(before, 0.0);  // it falls to the ground before it can meet six
}

TEST(SunThrow, APaneMirrorsByFresnelAndLetsTheRestThrough) {
  Bench bench({mirror_of(1.0), glass_of(1.5)});
  bench.scene.level({-100, -100, 100, 100}, 0.0);
  bench.scene.begin_object();
  bench.scene.wall({-1, 0, 1, 0}, 4.0, 6.0, 1);
  bench.scene.begin_object();
  bench.scene.wall({-20, -2, 20, -2}, 0.0, 20.0, 2);  // a pane before it
  const Vec3 sun = sun_at_degrees(180.0, 45.0);
  const ThrownSun thrown = bench.thrown(sun, {.depth = 1});
  // One face at 45 degrees, index 1.5: Fresnel's formulas give 0.0920134 and 0.0084665.
  const double s = 0.09201, p = 0.008467;
  const double through = 0.5 * ((1 - s) / (1 + s) + (1 - p) / (1 + p));
  double behind = 0.0;
  for (const ThrownPolygon& q : thrown.polygons) {
    if (bench.panels[q.panel].material != 1 || std::abs(q.corners[0].z) > 1e-9) continue;
    EXPECT_NEAR(q.lux, kNormalLux * sun.z * through * through, 2e-5 * kNormalLux);
    behind += q.area_m2;
  }
  EXPECT_NEAR(behind, 4.0, 1e-6);
  for (std::size_t k = 0; k < bench.panels.size(); ++k) {
    if (bench.panels[k].material == 2) {
      EXPECT_NEAR(thrown.panels[k].reflectance, 1.0 - through, 1e-5);
    }
  }
}

TEST(SunThrow, AMirrorEdgeOnAndASunThatIsDownThrowNothing) {
  Bench bench({mirror_of(1.0)});
  bench.scene.level({-100, -100, 100, 100}, 0.0);
  bench.scene.begin_object();
  bench.scene.wall({0, 5, 0, -5}, 1.0, 3.0, 1);
  EXPECT_TRUE(bench.thrown(sun_at_degrees(180.0, 40.0)).polygons.empty());
  EXPECT_TRUE(bench.thrown(sun_at_degrees(90.0, -1.0)).polygons.empty());
  EXPECT_FALSE(bench.thrown(sun_at_degrees(90.0, 40.0)).polygons.empty());
}

TEST(SunThrow, LightOnCoincidentGroundLandsOnce) {
  Bench bench({mirror_of(1.0)});
  bench.scene.level({-100, -100, 100, 100}, 0.0);
  bench.scene.begin_object();
  bench.scene.level({-90, -90, 95, 91}, 0.0);
  bench.scene.begin_object();
  bench.scene.wall({-1, 0, 1, 0}, 0.0, 4.0, 1);  // stands on it
  const Vec3 sun = sun_at_degrees(200.0, 20.0);
  const ThrownSun thrown = bench.thrown(sun);
  EXPECT_NEAR(lumen_of(thrown), kNormalLux * 8.0 * std::abs(sun.y), 1e-3);
}

TEST(SunThrow, AWindowInThePlaneOfAWallThatWasNotCutForItMirrors) {
  for (const double off : {0.0, 0.0005, -0.0005}) {  // the wall, before or behind
    Bench bench({mirror_of(1.0)});
    bench.scene.level({-100, -100, 100, 100}, 0.0);
    bench.scene.begin_object();
    bench.scene.wall({-10, off, 10, off}, 0.0, 10.0);
    bench.scene.begin_object();
    bench.scene.wall({-1, 0, 1, 0}, 2.0, 4.0, 1);
    const Vec3 sun = sun_at_degrees(200.0, 30.0);
    const ThrownSun thrown = bench.thrown(sun);
    EXPECT_NEAR(lumen_of(thrown), kNormalLux * 4.0 * std::abs(sun.y), 1e-3) << off;
  }
}

TEST(SunThrow, TenThousandNearlyCoplanarPanelsLoseNoLight) {
  // Turned by up to 0.01 degrees, each by itself; edges are shared with neighbours or cross them.
  Bench bench({mirror_of(1.0)});
  bench.scene.level({-400, -400, 400, 400}, 0.0);
  SampleRandom random(3, 0, 0);
  for (int k = 0; k < 10000; ++k) {
    bench.scene.begin_object();
    const double x = k % 100, z = 10.0 + k / 100;
    const double dy = 0.5 * std::tan(0.01 * kPi / 180.0) * (2.0 * random.uniform() - 1.0);
    bench.scene.wall({x, -dy, x + 1.0, dy}, z, z + 1.0, 1);
  }
  const Vec3 sun = sun_at_degrees(200.0, 50.0);
  const ThrownSun thrown = bench.thrown(sun);
  EXPECT_EQ(bench.panels.size(), 10000U);
  const double light = kNormalLux * 10000.0 * std::abs(sun.y);
  EXPECT_NEAR(lumen_of(thrown), light, 1e-3 * light);
  EXPECT_NEAR(thrown.landed_lm + thrown.sky_lm, thrown.started_lm, 1e-9 * light);
}

}  // namespace
}  // namespace tenku
