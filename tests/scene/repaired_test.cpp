// Scenes written as CityJSON and read back; strict reading.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "scene/cityjson_writer.h"
#include "tests/scene/gltf_texts.h"
#include "tests/scene/honeybee_texts.h"
#include "tests/scene/scene_files.h"

namespace tenku {
namespace {

const char* const kBuilding =
    R"({"type":"CityJSON","version":"2.0","metadata":{"referenceSystem":)"
    R"("https://www.opengis.net/def/crs/EPSG/0/7415"},"transform":{"scale":[0.001,0.001,0.001],)"
    R"("translate":[85000,447000,0]},"CityObjects":{"b":{"type":"Building","geometry":)"
    R"([{"type":"Solid","lod":"2.2","boundaries":[[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],)"
    R"([[2,3,7,6]],[[3,0,4,7]]]],"semantics":{"surfaces":[{"type":"RoofSurface"},)"
    R"({"type":"Window"}],"values":[[null,0,1,null,null,null]]}}]},"t":{"type":"TINRelief",)"
    R"("geometry":[{"type":"CompositeSurface","lod":"1","boundaries":[[[8,9,10]]]}]}},)"
    R"("vertices":[[0,0,0],[2000,0,0],[2000,3000,0],[0,3000,0],[0,0,4000],[2000,0,4000],)"
    R"([2000,3000,4000],[0,3000,4000],[-50000,-50000,0],[50000,-50000,0],[0,50000,0]]})";

/// Area by object, surface type and reflectance, which no order of surfaces changes.
std::map<std::string, double> areas_of(const Scene& scene) {
  std::map<std::string, double> areas;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const Material& m = scene.materials[scene.surfaces.material[s]];
    const std::string key = scene.objects[scene.surfaces.object[s]].id + " " +
                            std::string(name_of(scene.surfaces.type[s])) + " " +
                            std::to_string(luminance_of(m.reflectance)) + " " +
                            std::to_string(m.transmittance) + " " + std::to_string(m.mirror);
    areas[key] += length(area_vector(scene, s));
  }
  return areas;
}

Scene back(const Scene& scene) {
  return read_text("back.city.json", cityjson_of(scene), without_ground());
}

void expect_same(const Scene& scene, const Scene& again) {
  const auto one = areas_of(scene), other = areas_of(again);
  ASSERT_EQ(one.size(), other.size());
  for (const auto& [key, area] : one) {
    ASSERT_TRUE(other.contains(key)) << key;
    EXPECT_NEAR(other.at(key), area, 1e-4 * (1.0 + area)) << key;
  }
  const Measures a = measures(flatten(scene)), b = measures(flatten(again));
  EXPECT_NEAR(a.area, b.area, 1e-3 + 1e-6 * a.area);
}

TEST(Repaired, CityIsReadBackAsItWas) {
  const Scene scene = read_text("a.city.json", kBuilding);
  const Scene again = back(scene);
  expect_same(scene, again);
  EXPECT_EQ(again.georeference->crs, "EPSG:7415");
  EXPECT_EQ(again.objects[0].type, "Building");
  EXPECT_EQ(again.objects[1].type, "TINRelief");
  EXPECT_TRUE(again.has_terrain);
  EXPECT_TRUE(again.is_city);
  // The same places on the map, to the step of 0.01 mm.
  const Vec3 p = again.frame.to_local(scene.frame.to_file({1.0, 2.0, 3.0}));
  const Vec3 q = again.frame.to_local(scene.frame.to_file({0.0, 0.0, 0.0}));
  EXPECT_NEAR(length(p - q), std::sqrt(14.0), 1e-6);
  EXPECT_EQ(again.extent.min, scene.extent.min);
}

// What is written is JSON that any reader takes, with whole vertices and one value a surface.
TEST(Repaired, FileKeepsToTheSpecification) {
  const auto json = nlohmann::json::parse(cityjson_of(read_text("a.city.json", kBuilding)));
  EXPECT_EQ(json["type"], "CityJSON");
  EXPECT_EQ(json["version"], "2.0");
  EXPECT_EQ(json["metadata"]["referenceSystem"], "https://www.opengis.net/def/crs/EPSG/0/7415");
  for (const auto& vertex : json["vertices"]) {
    ASSERT_EQ(vertex.size(), 3U);
    for (const auto& x : vertex) EXPECT_TRUE(x.is_number_integer());
  }
  const auto& geometry = json["CityObjects"]["b"]["geometry"][0];
  EXPECT_EQ(geometry["lod"], "2.2");
  EXPECT_EQ(geometry["boundaries"].size(), 6U);
  EXPECT_EQ(geometry["semantics"]["values"].size(), 6U);
  // Vertex 0 in map coordinates.
  const auto& scale = json["transform"]["scale"];
  const auto& to = json["transform"]["translate"];
  const std::size_t v = geometry["boundaries"][0][0][0];
  EXPECT_NEAR(double(json["vertices"][v][0]) * double(scale[0]) + double(to[0]), 85000.0, 1e-5);
  EXPECT_NEAR(double(json["vertices"][v][1]) * double(scale[1]) + double(to[1]), 447000.0, 1e-5);
}

TEST(Repaired, GroundThatWasGivenIsThereAndNotGivenAgain) {
  std::string without = kBuilding;
  const auto at = without.find(R"("t":{"type":"TINRelief")");
  without.replace(without.find(R"(,"t":{)"),
                  without.find(R"(},"vertices")") - without.find(R"(,"t":{)"), "");
  ASSERT_NE(at, std::string::npos);
  const Scene scene = read_text("a.city.json", without);
  EXPECT_EQ(count_of(scene, "ground_added"), 1U);
  const Scene again = read_text("back.city.json", cityjson_of(scene));
  EXPECT_EQ(count_of(again, "ground_added"), 0U);
  expect_same(scene, again);
}

TEST(Repaired, MaterialsOfTheFileAreKept) {
  const Scene box = read_text("a.gltf", gltf_text());
  expect_same(box, back(box));
  const Scene room = read_text("a.hbjson", kHoneybee);
  const Scene again = back(room);
  expect_same(room, again);
  std::size_t panes = 0;
  for (const std::uint32_t m : again.surfaces.material) panes += again.materials[m].is_glass();
  EXPECT_EQ(panes, 1U);
}

TEST(Repaired, HolesAndOptionsAreWrittenAsTheyAreUsed) {
  // Turned by a quarter and twice as large: what is written needs no options.
  ReadOptions options;
  options.rotate = Angle::degrees(90.0);
  options.scale = 2.0;
  const Scene scene = read_text("a.obj", "v 0 0 0\nv 1 0 0\nv 1 3 0\nf 1 2 3\n", options);
  const Scene again = back(scene);
  expect_same(scene, again);
  EXPECT_NEAR(area_vector(again, 0).z, 6.0, 1e-9);
  EXPECT_NEAR(again.extent.max.x - again.extent.min.x, 6.0, 1e-9);  // its long side points east
}

TEST(Repaired, WhatWasMendedIsNotMendedAgain) {
  const Scene scene = read_text("a.obj",
                                "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 3 0\nv 2 0 0\n"
                                "f 1 2 2 3 4 5\nf 1 6 2\n");
  EXPECT_EQ(count_of(scene, "duplicate_vertices"), 1U);
  EXPECT_GE(count_of(scene, "repeated_vertex"), 1U);
  EXPECT_EQ(count_of(scene, "zero_area_face"), 1U);
  const Scene again = back(scene);
  for (const char* code : {"duplicate_vertices", "repeated_vertex", "zero_area_face"}) {
    EXPECT_EQ(count_of(again, code), 0U) << code;
  }
  expect_same(scene, again);
}

TEST(Strict, RefusesWhatWouldBeMendedAndTakesWhatIsWhole) {
  ReadOptions strict;
  strict.strict = true;
  EXPECT_EQ(read_text("a.city.json", kBuilding, strict).surfaces.size(), 7U);
  EXPECT_EQ(read_text("a.gltf", gltf_text(), strict).surfaces.size(), 12U);
  const auto refusal = [&](const std::string& name, const std::string& text) {
    try {
      read_text(name, text, strict);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string face = "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 2 0 0\nv 4 3 0\n";
  EXPECT_EQ(refusal("a.obj", face + "f 1 2 3\n"), "");
  EXPECT_NE(refusal("a.obj", face + "f 1 2 2 3\n").find("repeated_vertex"), std::string::npos);
  EXPECT_NE(refusal("a.obj", face + "f 1 2 3\nf 1 4 2\n").find("zero_area_face"),
            std::string::npos);
  EXPECT_NE(refusal("a.obj", face + "f 1 2 3\nf 1 2 5\n").find("duplicate_vertices"),
            std::string::npos);
  std::string no_crs = kBuilding;
  no_crs.replace(no_crs.find("referenceSystem"), 15, "referenceSystim");
  EXPECT_NE(refusal("a.city.json", no_crs).find("missing_crs"), std::string::npos);
  std::string inverted = kBuilding;
  for (const auto& [old, now] :
       std::initializer_list<std::pair<const char*, const char*>>{{"[0,3,2,1]", "[0,1,2,3]"},
                                                                  {"[4,5,6,7]", "[7,6,5,4]"},
                                                                  {"[0,1,5,4]", "[4,5,1,0]"},
                                                                  {"[1,2,6,5]", "[5,6,2,1]"},
                                                                  {"[2,3,7,6]", "[6,7,3,2]"},
                                                                  {"[3,0,4,7]", "[7,4,0,3]"}}) {
    inverted.replace(inverted.find(old), 9, now);
  }
  EXPECT_NE(refusal("a.city.json", inverted).find("inverted_shell"), std::string::npos);
}

}  // namespace
}  // namespace tenku
