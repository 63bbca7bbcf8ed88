#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/scene/scene_files.h"

namespace tenku {
namespace {

const char* const kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, PlainMeshKeepsItsCoordinatesAndHasNoGround) {
  const Scene scene = read_text("a.obj", std::string(kSquare) + "f 1 2 3 4\n");
  EXPECT_FALSE(scene.georeference.has_value());
  EXPECT_EQ(scene.objects.size(), 1U);
  EXPECT_EQ(scene.vertices[2], (Vec3{1, 1, 0}));
  EXPECT_EQ(scene.surfaces.type[0], SurfaceType::Unknown);
  EXPECT_EQ(flatten(scene).size(), 2U);
}

TEST(Obj, IndicesMayBeNegativeAndHaveTextureAndNormal) {
  const Scene scene =
      read_text("a.obj", std::string(kSquare) + "vt 0 0\nvn 0 0 1\nf -4/1/1 -3//1 -2/1 \\\n -1\n");
  EXPECT_EQ(scene.surfaces.outer_ring(0).size(), 4U);
}

TEST(Obj, CarriageReturnsPlusSignsAndCommentsAreBorne) {
  const Scene scene = read_text(
      "a.obj", "# a\r\n  v +1 .5 1e-3\r\nv 2 2. 0 1\r\nv 3 0 0 0.1 0.2 0.3\r\nf 1 2 3 # end\r\n");
  EXPECT_EQ(scene.vertices[0], (Vec3{1.0, 0.5, 0.001}));
}

TEST(Obj, YUpIsTurnedToZUpOnRequest) {
  ReadOptions options;
  options.up = UpAxis::Y;
  const Scene scene = read_text("a.obj", "v 0 0 0\nv 1 2 3\nv 0 1 0\nf 1 2 3\n", options);
  EXPECT_EQ(scene.vertices[1], (Vec3{1, -3, 2}));
  EXPECT_EQ(scene.frame.to_local({1, 2, 3}), (Vec3{1, -3, 2}));
  EXPECT_EQ(scene.frame.to_file({1, -3, 2}), (Vec3{1, 2, 3}));
  EXPECT_EQ(scene.frame.direction_to_local({0, 5, 0}), (Vec3{0, 0, 1}));
}

TEST(Obj, RotationIsClockwiseSeenFromAboveAndScaleIsMetresAUnit) {
  ReadOptions options;
  options.rotate = Angle::degrees(90.0);
  options.scale = 0.5;
  const Scene scene = read_text("a.obj", "v 0 2 0\nv 2 0 0\nv 0 0 2\nf 1 2 3\n", options);
  EXPECT_NEAR(length(scene.vertices[0] - Vec3{1, 0, 0}), 0.0, 1e-15);  // north has become east
  EXPECT_NEAR(length(scene.vertices[1] - Vec3{0, -1, 0}), 0.0, 1e-15);
  EXPECT_NEAR(scene.vertices[2].z, 1.0, 1e-15);
}

TEST(Obj, ObjectsAndGroupsBecomeObjects) {
  const Scene scene = read_text("a.obj", std::string(kSquare) +
                                             "o house\ng roof\nf 1 2 3\ng back wall\nf 1 3 4\n"
                                             "o other\ng\nf 1 2 4\no house\ng roof\nf 2 3 4\n");
  ASSERT_EQ(scene.objects.size(), 4U);
  EXPECT_EQ(scene.objects[1].id, "house/roof");
  EXPECT_EQ(scene.objects[1].parent, 0U);
  EXPECT_EQ(scene.objects[3].id, "other");
  EXPECT_EQ(scene.surfaces.object[3], 1U);
  EXPECT_EQ(scene.surfaces.type[0], SurfaceType::Roof);
  EXPECT_EQ(scene.surfaces.type[1], SurfaceType::Wall);
}

TEST(Obj, TypeComesFromMaterialOrGroupName) {
  for (const auto& [name, type] : std::initializer_list<std::pair<const char*, SurfaceType>>{
           {"ceil", SurfaceType::Ceiling},
           {"Floor_Tiles", SurfaceType::Floor},
           {"backWall", SurfaceType::Wall},
           {"glass.001", SurfaceType::Window},
           {"wallpaper", SurfaceType::Unknown},
           {"mat1", SurfaceType::Unknown}}) {
    const Scene scene = read_text("a.obj", std::string(kSquare) + "usemtl " + name + "\nf 1 2 3\n");
    EXPECT_EQ(scene.surfaces.type[0], type) << name;
  }
}

TEST(Obj, KdIsTheReflectanceAndIsBroughtDownTo09) {
  const TemporaryFolder folder;
  folder.write("my file.mtl", "newmtl red\nKd 1.0 0.2 0.1\nTr 0.5\nnewmtl b\nKd 0.4 0.4 0.4\n");
  const Scene scene = read(folder.write(
      "a.obj",
      std::string(kSquare) + "mtllib my file.mtl\nusemtl red\nf 1 2 3\nusemtl b\nf 1 3 4\n"));
  const Material& red = scene.materials[scene.surfaces.material[0]];
  EXPECT_EQ(red.name, "red");
  EXPECT_EQ(red.reflectance, (Rgb{0.9, 0.2, 0.1}));
  EXPECT_FALSE(red.is_glass());
  EXPECT_EQ(scene.materials[scene.surfaces.material[1]].reflectance, Rgb::grey(0.4));
  EXPECT_EQ(count_of(scene, "reflectance_clamped"), 1U);
}

TEST(Obj, KeyholePolygonKeepsItsHole) {
  // The hole is tied to the outer ring by an edge that is passed there and back.
  const Scene scene =
      read_text("a.obj",
                "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nv 1 1 0\nv 1 2 0\nv 2 2 0\nv 2 1 0\n"
                "f 1 2 3 4 1 5 6 7 8 5\n");
  EXPECT_NEAR(measures(flatten(scene)).area, 8.0, 1e-12);
}

TEST(Obj, HeaderCommentPlacesTheGrid) {
  const Scene scene = read_text(
      "a.obj",
      "# x = Easting - 70700.0, y = height above sea level (m), z = -(Northing - 352400.0); "
      "EPSG:31255 (MGI / Austria GK Central).\n"
      "v 0 250 0\nv 10 250 0\nv 0 260 0\nf 1 2 3\n");
  ASSERT_TRUE(scene.georeference.has_value());
  EXPECT_EQ(scene.georeference->crs, "EPSG:31255");
  EXPECT_TRUE(scene.is_city);
  EXPECT_NEAR(scene.georeference->origin.latitude.in_degrees(), 48.306, 0.001);
  EXPECT_NEAR(scene.vertices[0].z, 250.0, 1e-9);
  EXPECT_GT(scene.frame.direction_to_local({0, 0, -1}).y, 0.999);
}

TEST(Obj, HeaderPlaceOfThePolygonCityExportsIsRead) {
  const Scene scene = read_text("a.obj",
                                "# Longitude: 14.247033529189148\n# Latitude: 48.30784359396005\n"
                                "# Elevation: 260.56\nv 0 1 0\nv 1 1 0\nv 0 2 0\nf 1 2 3\n");
  ASSERT_TRUE(scene.georeference.has_value());
  EXPECT_EQ(scene.georeference->origin.longitude.in_degrees(), 14.247033529189148);
  EXPECT_EQ(scene.georeference->origin.elevation_m, 260.56);
  EXPECT_EQ(scene.vertices[0].z, 1.0);
}

TEST(Obj, RoomOfClosedWallsIsNotTurned) {
  // Inwards on purpose: a furnace. Only the solids of a city are turned.
  const Scene scene = read_text("a.obj",
                                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  EXPECT_LT(measures(flatten(scene)).volume, 0.0);
  EXPECT_EQ(count_of(scene, "inverted_shell"), 0U);
}

TEST(Obj, FarPlainMeshGetsAnOriginNearby) {
  const Scene scene = read_text("a.obj", "v 5e6 0 0\nv 5000001 0 0\nv 5e6 1 0\nf 1 2 3\n");
  EXPECT_LT(length(scene.vertices[0]), 2.0);
  EXPECT_EQ(scene.frame.to_local({5e6, 0, 0}), scene.vertices[0]);
}

}  // namespace
}  // namespace tenku
