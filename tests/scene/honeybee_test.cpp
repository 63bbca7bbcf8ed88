// Honeybee models: windows in their walls, modifiers, units, what two rooms share.
#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/scene/honeybee_texts.h"
#include "tests/scene/scene_files.h"

namespace tenku {
namespace {

std::string with(std::string text, const std::string& old, const std::string& now) {
  const auto at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), now);
}

std::size_t surface_of(const Scene& scene, const std::string& id) {
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    if (scene.objects[scene.surfaces.object[s]].id == id) return s;
  }
  ADD_FAILURE() << "no surface of " << id;
  return 0;
}

double area_of(const Scene& scene, const std::string& id) {
  return length(area_vector(scene, surface_of(scene, id)));
}

const Material& material_of(const Scene& scene, const std::string& id) {
  return scene.materials[scene.surfaces.material[surface_of(scene, id)]];
}

TEST(Honeybee, WindowsAndDoorsAreCutOutOfTheirWall) {
  const Scene scene = read_text("a.hbjson", kHoneybee);
  EXPECT_EQ(scene.format, "Honeybee");
  ASSERT_EQ(scene.surfaces.size(), 4U);
  EXPECT_NEAR(area_of(scene, "wall"), 12.0 - 2.0 - 2.0, 1e-12);
  EXPECT_NEAR(area_of(scene, "window"), 2.0, 1e-12);
  EXPECT_NEAR(area_of(scene, "door"), 2.0, 1e-12);
  EXPECT_NEAR(measures(flatten(scene)).area, 12.0 + 2.0, 1e-9);  // and the shade's triangle
  EXPECT_EQ(scene.surfaces.type[surface_of(scene, "window")], SurfaceType::Window);
  EXPECT_EQ(scene.surfaces.type[surface_of(scene, "door")], SurfaceType::Door);
  // The wall looks south, away from its room.
  EXPECT_LT(area_vector(scene, surface_of(scene, "wall")).y, 0.0);
  EXPECT_FALSE(scene.is_city);
  EXPECT_EQ(count_of(scene, "self_intersecting_ring"), 0U);
}

TEST(Honeybee, ModifiersComeFromTheObjectItsRoomOrTheGenericSet) {
  const Scene scene = read_text("a.hbjson", kHoneybee);
  EXPECT_EQ(material_of(scene, "wall").reflectance, (Rgb{0.4, 0.3, 0.2}));
  // 0.96 is the transmissivity of usual glass of 88 % transmittance (Radiance's manual).
  EXPECT_NEAR(material_of(scene, "window").transmittance, 0.88, 0.005);
  EXPECT_NEAR(material_of(scene, "shade").mirror, 0.9, 1e-12);
  EXPECT_EQ(material_of(scene, "door").name, "generic_opaque_door_0.50");
  EXPECT_EQ(material_of(scene, "door").reflectance, Rgb::grey(0.5));
  // Without a modifier of its own: the generic window passes 64 %.
  const Scene plain = read_text("a.hbjson", with(kHoneybee, R"({"modifier":"pane"})", "{}"));
  EXPECT_NEAR(material_of(plain, "window").transmittance, 0.64, 0.002);
  const Scene missing =
      read_text("a.hbjson", with(kHoneybee, R"("modifier":"pane")", R"("modifier":"nobody")"));
  EXPECT_EQ(count_of(missing, "missing_modifier"), 1U);
}

TEST(Honeybee, UnitsAreThoseOfTheModel) {
  const Scene scene = read_text("a.hbjson", with(kHoneybee, "Meters", "Feet"));
  EXPECT_NEAR(area_of(scene, "window"), 2.0 * 0.3048 * 0.3048, 1e-12);
  EXPECT_NEAR(scene.extent.max.x, 4.0, 1e-12);  // in coordinates of the file
  EXPECT_NEAR(scene.frame.to_file({0.3048, 0.0, 0.0}).x, 1.0, 1e-12);
  EXPECT_THROW(read_text("a.hbjson", with(kHoneybee, "Meters", "Cubits")), InputError);
}

TEST(Honeybee, WallBetweenRoomsIsThereOnce) {
  const auto room = [](const std::string& id, const std::string& other) {
    return R"({"type":"Room","identifier":"room_)" + id + R"(","faces":[{"type":"Face",)" +
           R"("identifier":")" + id +
           R"(","face_type":"Wall","boundary_condition":{"type":"Surface",)" +
           R"("boundary_condition_objects":[")" + other + R"(","room_)" + other + R"("]},)" +
           face3d("[0,0,0],[4,0,0],[4,0,3],[0,0,3]") + "}]}";
  };
  const Scene scene = read_text(
      "a.hbjson", R"({"type":"Model","rooms":[)" + room("a", "b") + "," + room("b", "a") + "]}");
  EXPECT_EQ(scene.surfaces.size(), 1U);
  EXPECT_EQ(count_of(scene, "shared_face"), 1U);
  EXPECT_EQ(count_of(scene, "coincident_faces"), 0U);
  EXPECT_EQ(material_of(scene, "a").name, "generic_wall_0.50");
}

TEST(Honeybee, AirBoundariesAndFacesThatAreAllWindowAreOpen) {
  const Scene air = read_text(
      "a.hbjson", with(kHoneybee, R"("face_type":"Wall")", R"("face_type":"AirBoundary")"));
  EXPECT_EQ(count_of(air, "air_boundary"), 1U);
  EXPECT_EQ(air.surfaces.size(), 3U);
  const Scene all = read_text("a.hbjson", with(kHoneybee, "[0.5,0,1],[2.5,0,1],[2.5,0,2],[0.5,0,2]",
                                               "[0,0,0],[4,0,0],[4,0,3],[0,0,3]"));
  EXPECT_EQ(all.surfaces.size(), 3U);
  EXPECT_NEAR(area_of(all, "window"), 12.0, 1e-12);
}

// Counts are the manifest's, extents too; areas of what is cut out are added back by the windows.
TEST(Honeybee, RealModelsAreRead) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "TENKU_DATA does not name the folder of real data";
  const auto read_model = [&](const char* name) {
    return read(*folder / "building" / "hbjson" / name);
  };
  const Scene holes = read_model("model_complete_holes.hbjson");
  EXPECT_EQ(holes.objects.size(), 1U + 10U + 1U + 1U);
  EXPECT_EQ(holes.surfaces.size(), 12U);
  const Scene rooms = read_model("model_complete_multiroom_radiance.hbjson");
  EXPECT_EQ(rooms.objects.size(), 3U + 17U + 8U);
  EXPECT_EQ(rooms.surfaces.size() + count_of(rooms, "shared_face"), 25U);
  const Scene mesh = read_model("model_with_shade_mesh.hbjson");
  EXPECT_EQ(mesh.objects.size(), 1U + 6U + 2U + 1U + 2U + 1U);
  EXPECT_NEAR(mesh.extent.max.z, 4.0, 1e-9);
  const Scene home = read_model("single_family_home.hbjson");
  EXPECT_EQ(home.objects.size(), 7U + 51U + 8U + 41U);
  EXPECT_NEAR(home.extent.min.x, -7.92171, 1e-6);
  EXPECT_NEAR(home.extent.max.y, 11.878351, 1e-6);
}

}  // namespace
}  // namespace tenku
