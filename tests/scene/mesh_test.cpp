// PLY, STL and Radiance: the same box in every encoding; Radiance's materials.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numbers>
#include <vector>

#include "scene/radiance_reader.h"
#include "tests/scene/mesh_texts.h"
#include "tests/scene/scene_files.h"

namespace tenku {
namespace {

void expect_box(const Scene& scene, const char* format) {
  EXPECT_EQ(scene.format, format);
  EXPECT_FALSE(scene.is_city);
  EXPECT_EQ(scene.vertices.size(), 8U);
  const Measures box = measures(flatten(scene));
  EXPECT_NEAR(box.area, 2.0 * (4.0 * 3.0 + 3.0 * 5.0 + 5.0 * 4.0), 1e-9);
  EXPECT_NEAR(box.volume, 60.0, 1e-9);
  EXPECT_EQ(count_of(scene, "duplicate_vertices"), 0U);
}

TEST(Ply, BoxIsTheSameInAllEncodings) {
  expect_box(read_text("a.ply", ascii_ply()), "PLY");
  expect_box(read_text("a.ply", binary_ply(std::endian::little)), "PLY");
  expect_box(read_text("a.ply", binary_ply(std::endian::big)), "PLY");
}

TEST(Ply, OtherElementsAndPropertiesArePassedOver) {
  const Scene scene =
      read_text("a.ply",
                "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\n"
                "element camera 1\r\nproperty list uchar float poses\r\n"
                "element vertex 3\r\nproperty uchar red\r\nproperty double x\r\n"
                "property double y\r\nproperty double z\r\n"
                "element face 1\r\nproperty list uchar int vertex_index\r\n"
                "property float quality\r\nend_header\r\n"
                "2 0.5 0.5\r\n255 0 0 0\r\n255 2 0 0\r\n255 0 2 0\r\n3 0 1 2 0.7\r\n");
  EXPECT_DOUBLE_EQ(measures(flatten(scene)).area, 2.0);
  EXPECT_EQ(count_of(scene, "ignored_element"), 1U);
}

TEST(Stl, BoxIsTheSameInBothEncodings) {
  expect_box(read_text("a.stl", ascii_stl()), "STL");
  expect_box(read_text("a.stl", binary_stl("a header")), "STL");
  // Some programs begin binary files with the word by which those of text are told.
  expect_box(read_text("a.stl", binary_stl("solid box")), "STL");
}

TEST(Stl, SolidsAreObjectsTypedByTheirNames) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\n";
  const Scene scene = read_text(
      "a.stl", "solid Roof 1\n" + facet + "endsolid Roof 1\nsolid\n" + facet + "endsolid\n");
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.objects[0].id, "Roof 1");
  EXPECT_EQ(scene.objects[1].id, "default");
  EXPECT_EQ(scene.surfaces.type[0], SurfaceType::Roof);
}

TEST(Radiance, PolygonsTakeTheMaterialOfTheirModifier) {
  const Scene scene =
      read_text("a.rad",
                "# a room\nvoid plastic white 0 0 5 .8 .7 .6 0 0\nvoid alias wallpaper white\n"
                "wallpaper polygon north_1\n0\n0\n12\n 0 0 0  4 0 0  4 0 3  0 0 3\n"
                "unheard_of polygon floor_1 0 0 9 0 0 0 1 0 0 0 1 0\n");
  ASSERT_EQ(scene.surfaces.size(), 2U);
  EXPECT_EQ(scene.format, "Radiance");
  EXPECT_EQ(scene.objects[0].id, "north_1");
  EXPECT_EQ(scene.materials[scene.surfaces.material[0]].reflectance, (Rgb{0.8, 0.7, 0.6}));
  EXPECT_EQ(scene.surfaces.type[1], SurfaceType::Floor);
  EXPECT_DOUBLE_EQ(scene.materials[scene.surfaces.material[1]].reflectance.r, 0.2);
}

// Radiance has no holes: the outline goes in by a seam and out by the same.
TEST(Radiance, SeamsOfHolesLeaveTheHoleOpen) {
  const Scene scene = read_text("a.rad",
                                "void polygon wall 0 0 30  0 0 0  4 0 0  4 4 0  0 4 0  0 0 0"
                                "  1 1 0  1 3 0  3 3 0  3 1 0  1 1 0\n");
  EXPECT_NEAR(measures(flatten(scene)).area, 12.0, 1e-9);
  ASSERT_EQ(scene.surfaces.size(), 1U);
  EXPECT_EQ(scene.surfaces.rings(0), 2U);
  EXPECT_EQ(count_of(scene, "self_intersecting_ring"), 0U);
}

TEST(Radiance, WhatIsNotReadIsTold) {
  const Scene scene = read_text("a.rad",
                                "!xform -t 1 0 0 \\\n  other.rad\nvoid mixfunc m 4 a b \"if(x, 1, "
                                "0)\" . 0 0\nvoid trans curtain 0 0 7 1 1 1 0 0 .5 0\n"
                                "curtain sphere ball 0 0 4 0 0 0 1\n"
                                "curtain polygon p 0 0 9 0 0 0 1 0 0 0 1 0\n");
  EXPECT_EQ(count_of(scene, "ignored_command"), 1U);
  EXPECT_EQ(count_of(scene, "ignored_shape"), 1U);
  EXPECT_EQ(count_of(scene, "unknown_material"), 2U);
  EXPECT_EQ(scene.surfaces.size(), 1U);
}

// The reference manual: 0.96 is the transmissivity of usual glass of 88 % transmittance.
TEST(Radiance, GlassHasTheTransmittanceOfThePane) {
  const Material usual = *radiance_material("glass", {0.96, 0.96, 0.96});
  EXPECT_NEAR(usual.transmittance, 0.88, 0.005);
  EXPECT_TRUE(usual.is_glass());
  // An index of 1 reflects nothing.
  EXPECT_DOUBLE_EQ(radiance_material("glass", {0.5, 0.5, 0.5, 1.0})->transmittance, 0.5);
  // Without absorption the faces alone reflect: (1 - r) / (1 + r), r = 0.0426 at 1.52.
  EXPECT_NEAR(radiance_material("glass", {1, 1, 1})->transmittance, 0.9183, 1e-4);
}

TEST(Radiance, SpecularPartsMirrorUnlessTheyAreRough) {
  const Material smooth = *radiance_material("plastic", {0.5, 0.4, 0.2, 0.1, 0});
  EXPECT_EQ(smooth.reflectance, (Rgb{0.45, 0.36000000000000004, 0.18000000000000002}));
  EXPECT_DOUBLE_EQ(smooth.mirror, 0.1);
  const Material rough = *radiance_material("plastic", {0.5, 0.5, 0.5, 0.1, 0.05});
  EXPECT_DOUBLE_EQ(rough.reflectance.g, 0.55);
  EXPECT_DOUBLE_EQ(rough.mirror, 0.0);
  const Material metal = *radiance_material("metal", {0.5, 0.5, 0.5, 1.0, 0});
  EXPECT_DOUBLE_EQ(metal.reflectance.g, 0.0);
  EXPECT_DOUBLE_EQ(metal.mirror, 0.5);
  const Material mirror = *radiance_material("mirror", {0.9, 0.9, 0.9});
  EXPECT_NEAR(mirror.mirror, 0.9, 1e-12);
  EXPECT_NEAR(mirror.mirror_tint.r, 1.0, 1e-12);
}

// A radiance of 1 W/sr/m2 is 179 cd/m2, and pi times that is the exitance of a diffuse lamp.
TEST(Radiance, LampsShineByTheirRadiance) {
  const Material lamp = *radiance_material("light", {10, 10, 10});
  EXPECT_NEAR(luminance_of(lamp.emission_lm_m2), 1790.0 * std::numbers::pi, 1e-9);
}

// A box of 300 m faces may be one of 300 mm; a sheet of terrain of such faces is none.
TEST(Sizes, TerrainTellsNoUnit) {
  const std::string box =
      "v 0 0 0\nv 300 0 0\nv 300 300 0\nv 0 300 0\nv 0 0 300\nv 300 0 300\nv 300 300 300\n"
      "v 0 300 300\no NAME\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const auto named = [&](const std::string& name) {
    return std::string(box).replace(box.find("NAME"), 4, name);
  };
  EXPECT_EQ(count_of(read_text("a.obj", named("block")), "unlikely_size"), 1U);
  EXPECT_EQ(count_of(read_text("a.obj", named("ground")), "unlikely_size"), 0U);
}

}  // namespace
}  // namespace tenku
