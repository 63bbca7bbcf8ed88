// glTF: the same box in every encoding, transforms, materials, what is told and what is refused.
#include <gtest/gtest.h>

#include <numbers>

#include "core/error.h"
#include "tests/scene/draco_texts.h"
#include "tests/scene/gltf_texts.h"
#include "tests/scene/scene_files.h"

namespace tenku {
namespace {

std::string with(std::string text, const std::string& old, const std::string& now) {
  const auto at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), now);
}

void expect_box(const Scene& scene) {
  EXPECT_EQ(scene.format, "glTF 2.0");
  EXPECT_EQ(scene.vertices.size(), 8U);
  const TriangleSoup soup = flatten(scene);
  EXPECT_EQ(soup.size(), 12U);
  const Measures box = measures(soup);
  EXPECT_NEAR(box.area, 2.0 * (4.0 * 3.0 + 3.0 * 5.0 + 5.0 * 4.0), 1e-5);
  EXPECT_NEAR(box.volume, 60.0, 1e-5);
  EXPECT_FALSE(scene.is_city);
}

/// Local corners of the box's extent.
Extent local_extent(const Scene& scene) {
  Extent box;
  for (const Vec3 v : scene.vertices) box.add(v);
  return box;
}

void expect_near(Vec3 a, Vec3 b) {
  EXPECT_LT(length(a - b), 1e-5) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(Gltf, BoxIsTheSameInAllEncodings) {
  expect_box(read_text("a.gltf", gltf_text()));
  expect_box(read_text("a.glb", glb()));
  const TemporaryFolder folder;
  folder.write("the box.bin", gltf_buffer());
  expect_box(read(folder.write("a.gltf", gltf_json("the%20box.bin"))));
}

TEST(Gltf, YPointsUpUnlessTold) {
  const Scene scene = read_text("a.gltf", gltf_text());
  expect_near(local_extent(scene).max, {4, 3, 5});
  expect_near(local_extent(scene).min, {0, 0, 0});
  EXPECT_EQ(scene.objects[0].id, "box");
  ReadOptions options;
  options.up = UpAxis::Z;
  expect_near(local_extent(read_text("a.gltf", gltf_text(), options)).max, {4, 5, 0});
}

TEST(Gltf, MeshWithoutIndicesStripsAndFansAreTriangles) {
  std::string points;
  for (const std::array<float, 3> v :
       {std::array<float, 3>{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}, {1, 2, 0}}) {
    for (const float x : v) points += bytes_of(x);
  }
  const auto area = [&](int mode) {
    return measures(
               flatten(read_text(
                   "a.gltf",
                   R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
                   R"({"attributes":{"POSITION":0},"mode":)" +
                       std::to_string(mode) +
                       R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":6,)"
                       R"("type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":72}],)"
                       R"("buffers":[{"byteLength":72,"uri":")" +
                       data_uri(points) + R"("}]})")))
        .area;
  };
  EXPECT_NEAR(area(4), 0.5 + 0.5, 1e-6);  // 0 1 2, 3 4 5
  EXPECT_NEAR(area(5), 2.0, 1e-6);        // the strip of two squares
  // The fan about the first corner: (0 1 2), (0 2 3), (0 3 4), (0 4 5).
  EXPECT_NEAR(area(6), 0.5 + 0.5 + 1.0 + 1.0, 1e-6);
  EXPECT_THROW(area(1), InputError);  // lines alone
}

// A strip turns every second triangle over, so that all face the same way (section 3.7.2.1).
TEST(Gltf, TrianglesOfAStripFaceTheSameWay) {
  std::string points;
  for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 1.F, 1.F, 0.F}) {
    points += bytes_of(x);
  }
  const Scene scene = read_text(
      "a.gltf", R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
                R"({"attributes":{"POSITION":0},"mode":5}]}],"accessors":[{"bufferView":0,)"
                R"("componentType":5126,"count":4,"type":"VEC3"}],"bufferViews":[{"buffer":0,)"
                R"("byteLength":48}],"buffers":[{"byteLength":48,"uri":")" +
                    data_uri(points) + R"("}]})");
  ASSERT_EQ(scene.surfaces.size(), 2U);
  // z of the file, the way that both look, is south.
  for (std::size_t s = 0; s < 2; ++s) EXPECT_NEAR(area_vector(scene, s).y, -0.5, 1e-6);
}

TEST(Gltf, NodesMoveTurnAndScale) {
  // Half as large, a quarter turn about the upward axis (x to -z of the file: east to north),
  // moved.
  const double half = std::numbers::sqrt2 / 2.0;
  const std::string turn = std::to_string(half);
  const Scene scene =
      read_text("a.gltf", gltf_text(R"("scale":[0.5,0.5,0.5],"rotation":[0,)" + turn + ",0," +
                                    turn + R"(],"translation":[10,2,-20])"));
  EXPECT_NEAR(measures(flatten(scene)).volume, 60.0 / 8.0, 1e-4);
  // The box spans x 0..4, y 0..3 to the north; turned it spans -3..0 to the east, 0..4 to the
  // north.
  expect_near(local_extent(scene).min, {10 - 1.5, 20, 2});
  expect_near(local_extent(scene).max, {10, 22, 4.5});
}

TEST(Gltf, MatricesOfParentsMultiply) {
  const std::string parent =
      R"({"children":[1],"matrix":[2,0,0,0,0,2,0,0,0,0,2,0,1,2,3,1]},{"mesh":0,"matrix":)"
      R"([1,0,0,0,0,1,0,0,0,0,1,0,10,0,0,1],"name":"box"})";
  const Scene scene = read_text("a.gltf", with(gltf_text(), R"({"mesh":0,"name":"box"})", parent));
  EXPECT_NEAR(measures(flatten(scene)).volume, 480.0, 1e-4);
  // x: 2 (0 + 10) + 1; y of the file is up: 2; z of the file is south: 3.
  expect_near(local_extent(scene).min, {21, -3, 2});
}

// Section 3.7.4: a mirroring transform turns the winding, so fronts stay in front.
TEST(Gltf, MirroredMeshesKeepTheirFronts) {
  const Scene scene = read_text("a.gltf", gltf_text(R"("scale":[-1,1,1])"));
  EXPECT_NEAR(measures(flatten(scene)).volume, 60.0, 1e-4);
  EXPECT_EQ(count_of(scene, "inverted_shell"), 0U);
}

TEST(Gltf, SparseValuesReplaceThoseOfTheBuffer) {
  // Corners 4 to 7 (the top) of a box whose top lies at 0 in the buffer.
  std::string flat;
  for (const auto& v : kBoxVertices) {
    for (const float x : {v[0], 0.F, -v[1]}) flat += bytes_of(x);
  }
  std::string bytes = flat + gltf_buffer().substr(96);
  for (const std::uint16_t k : {4, 5, 6, 7}) bytes += bytes_of(k);
  for (std::size_t k = 4; k < 8; ++k) {
    for (const float x : y_up(kBoxVertices[k])) bytes += bytes_of(x);
  }
  std::string json = gltf_json(data_uri(bytes));
  json = with(json, R"("count":8,)",
              R"("count":8,"sparse":{"count":4,"indices":{"bufferView":2,"componentType":5123},)"
              R"("values":{"bufferView":3}},)");
  json = with(json, R"("byteLength":72}])",
              R"("byteLength":72},{"buffer":0,"byteOffset":168,"byteLength":8},)"
              R"({"buffer":0,"byteOffset":176,"byteLength":48}])");
  json = with(json, R"("byteLength":168)", R"("byteLength":224)");
  expect_box(read_text("a.gltf", json));
  EXPECT_THROW(read_text("a.gltf", with(json, R"("byteOffset":168)", R"("byteOffset":176)")),
               InputError);  // the fourth index is then a piece of a float
}

TEST(Gltf, InterleavedAndQuantizedPositionsAreRead) {
  // 16-bit integers made fractions, 8 bytes apart, scaled back by the node.
  std::string bytes;
  for (const auto& v : kBoxVertices) {
    for (const float x : {v[0] / 5.F, v[2] / 5.F, -v[1] / 5.F}) {
      bytes += bytes_of(static_cast<std::int16_t>(std::lround(x * 32767.F)));
    }
    bytes += std::string(2, '\x7f');
  }
  bytes += gltf_buffer().substr(96);
  std::string json = gltf_json(data_uri(bytes), R"("scale":[5,5,5])");
  json = with(json, R"("componentType":5126,"count":8)",
              R"("componentType":5122,"normalized":true,"count":8)");
  json = with(json, R"("byteLength":96})", R"("byteLength":64,"byteStride":8})");
  json = with(json, R"("byteOffset":96)", R"("byteOffset":64)");
  json = with(json, R"("byteLength":168)", R"("byteLength":136)");
  const Scene scene = read_text("a.gltf", json);
  EXPECT_NEAR(measures(flatten(scene)).volume, 60.0, 60.0 * 3.0 * 0.5 / 32767.0 * 5.0);
}

TEST(Gltf, BaseColourIsTheReflectance) {
  const Scene scene = read_text("a.gltf", gltf_text());
  const Material& brick = scene.materials[scene.surfaces.material[0]];
  EXPECT_EQ(brick.name, "brick");
  EXPECT_EQ(brick.reflectance, (Rgb{0.5, 0.25, 0.125}));
  EXPECT_EQ(brick.mirror, 0.0);
  const Scene white = read_text("a.gltf", with(gltf_text(), "[0.5,0.25,0.125,1]", "[1,1,1,1]"));
  EXPECT_EQ(white.materials[white.surfaces.material[0]].reflectance, Rgb::grey(0.9));
  EXPECT_EQ(count_of(white, "reflectance_clamped"), 1U);
  // A material without a colour says nothing: the default of what is no known surface.
  const Scene none = read_text(
      "a.gltf",
      with(gltf_text(), R"("baseColorFactor":[0.5,0.25,0.125,1])", R"("roughnessFactor":0.5)"));
  EXPECT_EQ(none.materials[none.surfaces.material[0]].reflectance, Rgb::grey(0.3));
  const Scene roof = read_text("a.gltf", with(gltf_text(),
                                              R"("brick","pbrMetallicRoughness":)"
                                              R"({"baseColorFactor":[0.5,0.25,0.125,1]})",
                                              R"("Roof_01")"));
  EXPECT_EQ(roof.surfaces.type[0], SurfaceType::Roof);
}

TEST(Gltf, SmoothMetalMirrorsAndGlassPasses) {
  const Scene metal =
      read_text("a.gltf", with(gltf_text(), "[0.5,0.25,0.125,1]",
                               R"([0.8,0.8,0.8,1],"metallicFactor":1,"roughnessFactor":0)"));
  const Material& mirror = metal.materials[metal.surfaces.material[0]];
  EXPECT_NEAR(mirror.mirror, 0.8, 1e-12);
  EXPECT_EQ(mirror.reflectance, Rgb::grey(0.0));
  // Index 1.5 mirrors 4 % at normal incidence.
  const Scene glass =
      read_text("a.gltf", with(gltf_text(), R"("name":"brick",)",
                               R"("name":"brick","extensions":{"KHR_materials_transmission":)"
                               R"({"transmissionFactor":1}},)"));
  const Material& pane = glass.materials[glass.surfaces.material[0]];
  EXPECT_NEAR(pane.transmittance, 0.96 * luminance_of({0.5, 0.25, 0.125}), 1e-12);
  EXPECT_TRUE(pane.is_glass());
  const Scene veil =
      read_text("a.gltf", with(with(gltf_text(), "0.125,1]", "0.125,0.25]"), R"("name":"brick",)",
                               R"("name":"brick","alphaMode":"BLEND",)"));
  EXPECT_NEAR(veil.materials[veil.surfaces.material[0]].transmittance, 0.75, 1e-12);
  EXPECT_NEAR(veil.materials[veil.surfaces.material[0]].reflectance.r, 0.125, 1e-12);
}

// 100 cd/m2 from a diffuse surface is an exitance of 100 pi lm/m2.
TEST(Gltf, EmissionIsInCandelas) {
  const Scene scene =
      read_text("a.gltf", with(gltf_text(), R"("name":"brick",)",
                               R"("name":"brick","emissiveFactor":[1,1,1],"extensions":)"
                               R"({"KHR_materials_emissive_strength":{"emissiveStrength":100}},)"));
  EXPECT_NEAR(luminance_of(scene.materials[scene.surfaces.material[0]].emission_lm_m2),
              100.0 * std::numbers::pi, 1e-9);
  EXPECT_EQ(count_of(scene, "two_sided_lamp"), 1U);
}

TEST(Gltf, WhatIsNotReadIsTold) {
  const Scene textured = read_text("a.gltf", with(gltf_text(), "[0.5,0.25,0.125,1]",
                                                  R"([1,1,1,1],"baseColorTexture":{"index":0})"));
  EXPECT_EQ(count_of(textured, "texture_ignored"), 1U);
  EXPECT_EQ(textured.materials[textured.surfaces.material[0]].reflectance, Rgb::grey(0.3));
  const Scene animated =
      read_text("a.gltf", with(gltf_text(), R"("scene":0,)", R"("scene":0,"animations":[{}],)"));
  EXPECT_EQ(count_of(animated, "ignored_animation"), 1U);
  const std::string lines = R"("primitives":[{"attributes":{"POSITION":0},"mode":1},)"
                            R"({"attributes":{"POSITION":0},"mode":0},)";
  const Scene drawn = read_text("a.gltf", with(gltf_text(), R"("primitives":[)", lines));
  EXPECT_EQ(count_of(drawn, "not_a_surface"), 2U);
  EXPECT_EQ(drawn.surfaces.size(), 12U);
  EXPECT_THROW(read_text("a.gltf", with(gltf_text(), R"("scene":0,)",
                                        R"("extensionsRequired":["EXT_meshopt_compression"],)")),
               InputError);
}

TEST(Gltf, MeshesPackedByDracoAreUnpacked) {
  const std::string packed = packed_box();
  const Scene scene = read_text("a.gltf", draco_json(packed));
  EXPECT_EQ(flatten(scene).size(), 12U);
  // 14 bits over 5 m are steps of 0.3 mm.
  EXPECT_NEAR(measures(flatten(scene)).volume, 60.0, 60.0 * 3.0 * 0.0004);
  for (std::size_t cut = 0; cut < packed.size(); cut += 5) {
    EXPECT_THROW(read_text("a.gltf", draco_json(packed.substr(0, cut))), InputError) << cut;
  }
}

}  // namespace
}  // namespace tenku
