#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "tests/scene/scene_files.h"

namespace tenku {
namespace {

// A box of 2 x 3 x 4 m about the origin of a file with millimetres.
const char* const kBoxVertices =
    "[0,0,0],[2000,0,0],[2000,3000,0],[0,3000,0],"
    "[0,0,4000],[2000,0,4000],[2000,3000,4000],[0,3000,4000]";
const char* const kBoxShell =
    "[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]";
const char* const kInsideOut =
    "[[[1,2,3,0]],[[7,6,5,4]],[[4,5,1,0]],[[5,6,2,1]],[[6,7,3,2]],[[7,4,0,3]]]";

std::string document(const std::string& objects, const std::string& vertices = kBoxVertices,
                     const std::string& more = "") {
  return R"({"type":"CityJSON","version":"2.0",)" + more +
         R"("transform":{"scale":[0.001,0.001,0.001],"translate":[10,20,30]},"CityObjects":{)" +
         objects + R"(},"vertices":[)" + vertices + "]}";
}

std::string object(const std::string& id, const std::string& type, const std::string& geometry,
                   const std::string& more = "") {
  return "\"" + id + "\":{\"type\":\"" + type + "\"," + more + "\"geometry\":[" + geometry + "]}";
}

std::string solid(const std::string& lod, const std::string& shells, const std::string& more = "") {
  return R"({"type":"Solid","lod":")" + lod + R"(","boundaries":[)" + shells + "]" + more + "}";
}

Scene read_box(const std::string& text) { return read_text("a.city.json", text, without_ground()); }

TEST(CityJson, BoxHasItsAreaVolumeAndExtent) {
  const Scene scene = read_box(document(object("b", "Building", solid("2", kBoxShell))));
  const TriangleSoup soup = flatten(scene);
  EXPECT_EQ(soup.size(), 12U);
  EXPECT_NEAR(measures(soup).area, 2 * (2 * 3 + 3 * 4 + 2 * 4), 1e-9);
  EXPECT_NEAR(measures(soup).volume, 24.0, 1e-9);
  EXPECT_NEAR(scene.extent.min.x, 10.0, 1e-12);
  EXPECT_NEAR(scene.extent.max.z, 34.0, 1e-12);
  EXPECT_EQ(scene.format, "CityJSON 2.0");
  EXPECT_EQ(count_of(scene, "open_shell"), 0U);
}

TEST(CityJson, BuildingWithoutSemanticsIsTypedByNormal) {
  const TriangleSoup soup =
      flatten(read_box(document(object("b", "Building", solid("2", kBoxShell)))));
  std::array<int, kSurfaceTypes> counts{};
  for (const SurfaceType type : soup.surface_type) ++counts[static_cast<std::size_t>(type)];
  EXPECT_EQ(counts[static_cast<std::size_t>(SurfaceType::Roof)], 2);
  EXPECT_EQ(counts[static_cast<std::size_t>(SurfaceType::Ground)], 2);
  EXPECT_EQ(counts[static_cast<std::size_t>(SurfaceType::Wall)], 8);
}

TEST(CityJson, SemanticsGoToTheirSurfaces) {
  const std::string semantics =
      R"(,"semantics":{"surfaces":[{"type":"Window"},{"type":"ClosureSurface"},{"type":"+Odd"}],)"
      R"("values":[[null,0,1,2,null,0]]})";
  const Scene scene = read_box(document(object("b", "Building", solid("3", kBoxShell, semantics))));
  ASSERT_EQ(scene.surfaces.size(), 5U);  // a closure surface is not there
  EXPECT_EQ(scene.surfaces.type[0], SurfaceType::Ground);
  EXPECT_EQ(scene.surfaces.type[1], SurfaceType::Window);
  EXPECT_EQ(scene.surfaces.type[2], SurfaceType::Wall);
  EXPECT_EQ(scene.surfaces.type[4], SurfaceType::Window);
  EXPECT_EQ(count_of(scene, "closure_surface"), 1U);
  EXPECT_EQ(count_of(scene, "unknown_semantic_type"), 1U);
}

TEST(CityJson, InvertedShellIsTurnedAndCounted) {
  const Scene scene = read_box(document(object("b", "Building", solid("2", kInsideOut))));
  EXPECT_NEAR(measures(flatten(scene)).volume, 24.0, 1e-9);
  EXPECT_EQ(count_of(scene, "inverted_shell"), 1U);
}

TEST(CityJson, OpenShellIsToldWithItsObject) {
  const Scene scene = read_box(document(object("b", "Building", solid("2", "[[[0,3,2,1]]]"))));
  ASSERT_EQ(count_of(scene, "open_shell"), 1U);
  for (const Finding& finding : scene.findings) {
    if (finding.code != "open_shell") continue;
    EXPECT_EQ(finding.object, "b");
  }
}

TEST(CityJson, HighestLodIsReadUnlessAnotherIsAskedFor) {
  const std::string both = solid("1.2", kBoxShell) + "," + solid("1.3", kBoxShell) + "," +
                           R"({"type":"MultiSurface","lod":"2.2","boundaries":[[[0,1,2,3]]]})";
  const std::string text = document(object("b", "Building", both));
  const Scene highest = read_box(text);
  EXPECT_EQ(highest.surfaces.size(), 1U);
  EXPECT_EQ(highest.lods, std::vector<std::string>{"2.2"});
  EXPECT_EQ(highest.lod_triangles.at("1.2"), 12U);
  EXPECT_EQ(highest.lod_triangles.at("2.2"), 2U);
  ReadOptions options = without_ground();
  options.building_lod = "1";  // the family: the best of 1.2 and 1.3
  EXPECT_EQ(read_text("a.json", text, options).lods, std::vector<std::string>{"1.3"});
  options.building_lod = "3";
  EXPECT_EQ(count_of(read_text("a.json", text, options), "missing_lod"), 1U);
}

TEST(CityJson, FootprintIsLeftOutWhereThePartHasMore) {
  const std::string footprint = R"({"type":"MultiSurface","lod":"0","boundaries":[[[0,1,2,3]]]})";
  const Scene scene = read_box(
      document(object("b", "Building", footprint, R"("children":["p"],)") + "," +
               object("p", "BuildingPart", solid("2.2", kBoxShell), R"("parents":["b"],)")));
  EXPECT_EQ(scene.surfaces.size(), 6U);
  EXPECT_EQ(scene.objects.at(1).parent, 0U);
}

TEST(CityJson, LodMayBeANumberAsInVersion1) {
  const std::string geometry = R"({"type":"MultiSurface","lod":2,"boundaries":[[[0,1,2,3]]]})";
  EXPECT_EQ(read_box(document(object("r", "Road", geometry))).lods, std::vector<std::string>{"2"});
}

TEST(CityJson, HoleIsNotFilled) {
  const std::string vertices =
      "[0,0,0],[9000,0,0],[9000,9000,0],[0,9000,0],"
      "[3000,3000,0],[3000,6000,0],[6000,6000,0],[6000,3000,0]";
  const std::string roof =
      R"({"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2,3],[4,5,6,7]]]})";
  const TriangleSoup soup = flatten(read_box(document(object("b", "Building", roof), vertices)));
  EXPECT_EQ(soup.size(), 8U);
  EXPECT_NEAR(measures(soup).area, 81.0 - 9.0, 1e-9);
}

TEST(CityJson, MultiSolidsAndInnerShellsAreRead) {
  const std::string multi = R"({"type":"MultiSolid","lod":"2","boundaries":[[)" +
                            std::string(kBoxShell) + "],[" + kBoxShell + "]]}";
  EXPECT_EQ(read_box(document(object("b", "Building", multi))).surfaces.size(), 12U);
}

// Scaled by 2 and moved by 100 about the reference point (10, 20, 30): by hand.
TEST(CityJson, TemplateIsPlacedByMatrixAndReferencePoint) {
  const std::string templates =
      R"("geometry-templates":{"templates":[{"type":"MultiSurface","lod":"1","boundaries":)"
      R"([[[0,1,2]]]}],"vertices-templates":[[0,0,0],[1,0,0],[0,1,0]]},)";
  const std::string instance =
      R"({"type":"GeometryInstance","template":0,"boundaries":[0],"transformationMatrix":)"
      R"([2,0,0,100,0,2,0,0,0,0,2,0,0,0,0,1]})";
  const Scene scene = read_box(
      document(object("t", "SolitaryVegetationObject", instance), kBoxVertices, templates));
  ASSERT_EQ(scene.vertices.size(), 3U);
  EXPECT_EQ(scene.vertices[0], (Vec3{110, 20, 30}));
  EXPECT_EQ(scene.vertices[1], (Vec3{112, 20, 30}));
  EXPECT_EQ(scene.vertices[2], (Vec3{110, 22, 30}));
  EXPECT_EQ(scene.surfaces.type[0], SurfaceType::Vegetation);
}

TEST(CityJsonSeq, EachFeatureHasItsOwnVertices) {
  const std::string header =
      R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[5,0,0]},)"
      R"("CityObjects":{},"vertices":[]})";
  const auto feature = [](const std::string& id, const std::string& x) {
    return R"({"type":"CityJSONFeature","id":")" + id + R"(","CityObjects":{)" +
           object(id, "Building", R"({"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]})") +
           "},\"vertices\":[[" + x + ",0,0],[1,0,0],[0,1,0]]}";
  };
  const Scene scene = read_text(
      "a.city.jsonl", header + "\n" + feature("a", "0") + "\n" + feature("b", "-3") + "\n",
      without_ground());
  EXPECT_EQ(scene.format, "CityJSONSeq 2.0");
  EXPECT_EQ(scene.objects.size(), 2U);
  EXPECT_NEAR(scene.extent.min.x, 2.0, 1e-12);
}

TEST(CityJson, GroundIsGivenToACityWithoutTerrainOnly) {
  const std::string building = object("b", "Building", solid("2", kBoxShell));
  const std::string flat = R"({"type":"CompositeSurface","lod":"1","boundaries":[[[0,1,2,3]]]})";
  const Scene city = read_text("a.json", document(building));
  EXPECT_EQ(city.objects.back().id, kGroundObjectId);
  EXPECT_EQ(count_of(city, "ground_added"), 1U);
  EXPECT_NEAR(city.vertices.back().z, 30.0, 1e-12);
  const Scene terrain =
      read_text("a.json", document(building + "," + object("t", "TINRelief", flat)));
  EXPECT_EQ(count_of(terrain, "ground_added"), 0U);
  const Scene furniture = read_text("a.json", document(object("c", "CityFurniture", flat)));
  EXPECT_EQ(count_of(furniture, "ground_added"), 0U);
}

TEST(CityJson, BuildingsAboveTheGroundGivenReachDownToIt) {
  // Two cubes with sides of 1 m, one of them 7 m above the other and 10 m to the east.
  const std::string obj =
      "# x = Easting - 0.0, y = Northing - 0.0, z = height; EPSG:31255\n"
      "o low\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
      "o high\nv 10 0 7\nv 11 0 7\nv 11 1 7\nv 10 1 7\nv 10 0 8\nv 11 0 8\nv 11 1 8\nv 10 1 8\n"
      "f 12 11 10 9\nf 13 14 15 16\nf 9 10 14 13\nf 10 11 15 14\nf 11 12 16 15\nf 12 9 13 16\n";
  const Scene city = read_text("a.obj", obj);
  ASSERT_EQ(count_of(city, "ground_added"), 1U);
  EXPECT_EQ(count_of(city, "feet_lowered"), 1U);
  const TriangleSoup soup = flatten(city);
  double wall_area = 0.0;  // upright: 4 m2 of the low cube, 4 x 8 m2 of the other
  for (std::uint32_t t = 0; t < soup.size(); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    const Vec3 n = cross(soup.vertices[b] - soup.vertices[a], soup.vertices[c] - soup.vertices[a]);
    if (std::abs(n.z) < 1e-9) wall_area += 0.5 * length(n);
  }
  EXPECT_NEAR(wall_area, 36.0, 1e-3);  // lengths of the grid are not quite true ones
}

TEST(CityJson, DuplicateAndDegenerateGeometryIsMendedAndCounted) {
  const std::string vertices = "[0,0,0],[1000,0,0],[1000,1000,0],[0,1000,0],[0,0,0],[500,0,0]";
  const std::string geometry =
      R"({"type":"MultiSurface","lod":"2","boundaries":[[[0,1,1,2,3,4]],[[0,1,0]],[[0,5,1]]]})";
  const Scene scene = read_box(document(object("c", "CityFurniture", geometry), vertices));
  EXPECT_EQ(scene.surfaces.size(), 1U);
  EXPECT_EQ(flatten(scene).size(), 2U);
  EXPECT_EQ(count_of(scene, "duplicate_vertices"), 1U);
  EXPECT_EQ(count_of(scene, "degenerate_ring"), 1U);
  EXPECT_EQ(count_of(scene, "zero_area_face"), 1U);
}

TEST(CityJson, SelfIntersectingAndBentFacesAreTold) {
  const std::string bow_tie =
      R"({"type":"MultiSurface","lod":"2","boundaries":[[[0,2,1,3]],[[4,5,6,7]]]})";
  const std::string vertices =
      "[0,0,0],[2000,0,0],[2000,2000,0],[0,2000,0],[0,0,0],[2000,0,50],[2000,2000,0],[0,2000,50]";
  const Scene scene = read_box(document(object("c", "CityFurniture", bow_tie), vertices));
  EXPECT_EQ(count_of(scene, "self_intersecting_ring"), 1U);
  EXPECT_EQ(count_of(scene, "nonplanar_over_1cm"), 1U);
  // Two triangles of the bow tie about its crossing at (1, 1), and the bent square.
  EXPECT_NEAR(measures(flatten(scene)).area, 2.0 * 1.0 + 4.0, 0.01);
}

}  // namespace
}  // namespace tenku
