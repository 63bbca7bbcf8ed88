#include "scene/georeference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "scene/file_frame.h"
#include "tests/scene/scene_files.h"

namespace tenku {
namespace {

constexpr double kEarthRadius_m = 6378137.0;

// swisstopo, "Approximate formulas for the transformation between Swiss projection coordinates and
// WGS 84", 2016, numerical example: E 2700000, N 1100000 is 8 deg 43' 49.79" E, 46 deg 2' 38.87" N
// (from the rigorous service NAVREF, to 0.01").
TEST(Crs, SwissExampleHasThePositionThatSwisstopoPublishes) {
  const Georeference at = Crs::parse("EPSG:2056").at({2700000.0, 1100000.0, 600.0});
  EXPECT_NEAR(at.origin.longitude.in_degrees(), 8.0 + 43.0 / 60 + 49.79 / 3600, 0.01 / 3600);
  EXPECT_NEAR(at.origin.latitude.in_degrees(), 46.0 + 2.0 / 60 + 38.87 / 3600, 0.01 / 3600);
}

// Kadaster: (155000, 463000) is the tower of Our Lady at Amersfoort, the centre of the projection:
// Bessel 52 deg 9' 22.178" N, 5 deg 23' 15.500" E; scale 0.9999079 there by definition.
TEST(Crs, CentreOfTheDutchGridHasNoConvergenceAndItsDefinedScale) {
  const Georeference centre = Crs::parse("urn:ogc:def:crs:EPSG::28992").at({155000, 463000, 0});
  EXPECT_NEAR(centre.origin.latitude.in_degrees(), 52.155, 0.0005);
  EXPECT_NEAR(centre.origin.longitude.in_degrees(), 5.387, 0.0005);
  // The datum shift to WGS 84 turns and stretches by parts in a million.
  EXPECT_NEAR(centre.grid_convergence.in_degrees(), 0.0, 0.002);
  EXPECT_NEAR(centre.point_scale, 0.9999079, 1e-5);
}

// Transverse Mercator: convergence atan(tan(dl) sin(lat)) on the sphere, 2e-5 degrees off here;
// scale k0 (1 + E^2 / 2 R^2).
TEST(Crs, JapanesePlaneHasTheConvergenceAndScaleOfItsProjection) {
  const Georeference at = Crs::parse("EPSG:6677").at({-36767.0, -8060.0, 0.0});
  const double dl = at.origin.longitude.in_radians() - (139.0 + 50.0 / 60.0) * kPi / 180.0;
  const double expected =
      std::atan(std::tan(dl) * std::sin(at.origin.latitude.in_radians())) * 180.0 / kPi;
  EXPECT_NEAR(at.grid_convergence.in_degrees(), expected, 1e-4);
  EXPECT_LT(at.grid_convergence.in_degrees(), 0.0);  // west of the meridian
  EXPECT_NEAR(at.point_scale, 0.9999 * (1.0 + 0.5 * std::pow(36767.0 / kEarthRadius_m, 2)), 1e-7);
}

// A building of the Linz data set: grid position from the composed city, longitude and latitude as
// the authors' export gives them.
TEST(Crs, LinzBuildingIsWhereItsExportSays) {
  const Georeference at = Crs::parse("EPSG:31255").at({67837.544, 352580.759, 0.0});
  EXPECT_NEAR(at.origin.longitude.in_degrees(), 14.247033529189148, 3e-5);  // 2 m
  EXPECT_NEAR(at.origin.latitude.in_degrees(), 48.30784359396005, 2e-5);
}

TEST(Crs, FeetAreTurnedIntoMetres) {
  const Georeference at = Crs::parse("EPSG:2263").at({987000.0, 211000.0, 0.0});  // New York
  EXPECT_NEAR(at.metres_per_unit, 1200.0 / 3937.0, 1e-12);
  EXPECT_NEAR(at.origin.latitude.in_degrees(), 40.746, 0.01);
  EXPECT_NEAR(at.point_scale, 1.0, 1e-4);
}

TEST(Crs, AllSpellingsAreUnderstood) {
  for (const char* text : {"EPSG:7415", "urn:ogc:def:crs:EPSG::7415", "7415",
                           "https://www.opengis.net/def/crs/EPSG/0/7415",
                           "http://www.opengis.net/def/crs/EPSG/0/7415"}) {
    EXPECT_EQ(Crs::parse(text).id, "EPSG:7415") << text;
  }
  EXPECT_THROW(Crs::parse("EPSG:999999"), InputError);
  EXPECT_THROW(Crs::parse("here"), InputError);
  EXPECT_THROW(Crs::parse("EPSG:4978"), InputError);  // geocentric
}

std::string triangle_at(const std::string& crs, const std::string& points) {
  return R"({"type":"CityJSON","version":"2.0","metadata":{"referenceSystem":")" + crs +
         R"("},"CityObjects":{"b":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"1",)"
         R"("boundaries":[[[0,1,2]]]}]}},"vertices":[)" +
         points + "]}";
}

// Lengths of 0.01 degrees by the radii of curvature of GRS 80 (e^2 = 0.00669438): along the
// meridian M at 35.685 N, along the parallel N cos(lat) at 35.68 N.
TEST(Georeference, DegreesBecomeLocalMetresInEitherOrder) {
  const std::string latitude_first = "[35.68,139.76,3.5],[35.69,139.76,3.5],[35.68,139.77,3.5]";
  const std::string longitude_first = "[139.76,35.68,3.5],[139.76,35.69,3.5],[139.77,35.68,3.5]";
  for (const std::string& points : {latitude_first, longitude_first}) {
    const Scene scene =
        read_text("a.json", triangle_at("https://www.opengis.net/def/crs/EPSG/0/6697", points),
                  without_ground());
    ASSERT_TRUE(scene.georeference.has_value());
    const Vec3 a = scene.vertices[0], b = scene.vertices[1], c = scene.vertices[2];
    EXPECT_NEAR(length(b - a), 1109.5317, 0.001);
    EXPECT_NEAR(length(c - a), 905.2653, 0.001);
    EXPECT_GT((b - a).y, 1109.0);
    EXPECT_NEAR(a.z, 3.5, 1e-9);
    const Vec3 back = scene.frame.to_file(c);
    EXPECT_NEAR(length(back - scene.frame.to_file(scene.frame.to_local(back))), 0.0, 1e-10);
  }
}

TEST(Georeference, LocalNorthIsTrueNorthAndLengthsAreTrue) {
  const Scene scene = read_text(
      "a.json", triangle_at("EPSG:7415", "[78600,457900,0],[78600,458000,0],[78700,457900,0]"),
      without_ground());
  const Vec3 north = scene.vertices[1] - scene.vertices[0];
  const Georeference& at = *scene.georeference;
  EXPECT_NEAR(azimuth_of(north).in_degrees() - 360.0, at.grid_convergence.in_degrees(), 1e-9);
  EXPECT_LT(at.grid_convergence.in_degrees(), -0.8);  // 115 km west of the central meridian
  EXPECT_NEAR(length(north), 100.0 / at.point_scale, 1e-9);
  EXPECT_NEAR(length(scene.frame.to_file(scene.vertices[2]) - Vec3{78700, 457900, 0}), 0.0, 1e-6);
}

// What FileFrame's header says of using the origin's scale and convergence 5 km away.
TEST(Georeference, ScaleAndConvergenceChangeByLessThanTheHeaderSays) {
  struct Site {
    const char* crs;
    Vec3 origin;
  };
  for (const auto& [crs, origin] :
       std::initializer_list<Site>{{"EPSG:28992", {80000, 455000, 0}},
                                   {"EPSG:2056", {2683000, 1248000, 0}},
                                   {"EPSG:6677", {-8800, -36700, 0}},
                                   {"EPSG:31255", {70700, 352400, 0}}}) {
    const Crs grid = Crs::parse(crs);
    const Georeference here = grid.at(origin);
    for (const Vec3 step : {Vec3{5000, 0, 0}, Vec3{0, 5000, 0}, Vec3{-5000, 0, 0}}) {
      const Georeference there = grid.at(origin + step);
      EXPECT_NEAR(there.point_scale / here.point_scale, 1.0, 1.2e-5) << crs;
      EXPECT_NEAR((there.grid_convergence - here.grid_convergence).in_degrees(), 0.0, 0.06) << crs;
    }
  }
}

TEST(Georeference, OptionsOverrideTheFile) {
  ReadOptions options = without_ground();
  options.crs = "EPSG:6677";
  options.site = Location{Angle::degrees(43.06), Angle::degrees(141.35), 20.0};
  const std::string points = "[0,0,0],[1,0,0],[0,1,0]";
  const Scene scene = read_text("a.json", triangle_at("EPSG:7415", points), options);
  EXPECT_EQ(scene.georeference->crs, "EPSG:6677");
  EXPECT_EQ(scene.georeference->origin.latitude.in_degrees(), 43.06);
  options.crs = "EPSG:nonsense";
  EXPECT_THROW(read_text("a.json", triangle_at("EPSG:7415", points), options), InputError);
}

TEST(Georeference, MissingAndUnusableCrsAreFindings) {
  const std::string points = "[0,0,0],[1,0,0],[0,1,0]";
  const Scene odd = read_text("a.json", triangle_at("EPSG:999999", points), without_ground());
  EXPECT_EQ(count_of(odd, "unusable_crs"), 1U);
  EXPECT_FALSE(odd.georeference.has_value());
}

}  // namespace
}  // namespace tenku
