// A folder of tiles as one city.
#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/scene/citygml_texts.h"

namespace tenku {
namespace {

std::string shifted_box(const std::string& id) {
  std::string text = box_building(id);
  for (std::size_t at = 0; (at = text.find("1000", at)) != std::string::npos; at += 4) {
    text.replace(at, 4, "1001");
  }
  return text;
}

TEST(CityFolder, TilesAreJoinedInTheOrderOfTheirNames) {
  const TemporaryFolder folder;
  folder.write("b.gml", city_model(shifted_box("second"), "3.0"));
  folder.write("a.gml", city_model(box_building("first")));
  folder.write("readme.txt", "not a tile");
  const Scene scene = read(folder.path(), without_ground());
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.objects[0].id, "first");
  EXPECT_EQ(scene.objects[1].id, "second");
  EXPECT_EQ(scene.surfaces.size(), 12U);
  EXPECT_EQ(scene.lod_triangles.at("2"), 24U);
  EXPECT_EQ(scene.extent.min.x, 100000.0);
  EXPECT_EQ(scene.extent.max.x, 100104.0);
  // Two boxes of 4 by 3 by 5 m; the map's scale there is 1 - 9e-5.
  EXPECT_NEAR(measures(flatten(scene)).volume, 120.0, 0.06);
  EXPECT_EQ(count_of(scene, "open_shell"), 0U);
}

TEST(CityFolder, PartsKeepTheirParentsAndFoldersMayHoldFolders) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "deeper");
  const auto with_part = [](const std::string& id) {
    return building(id, "<bldg:consistsOfBuildingPart><bldg:BuildingPart gml:id=\"" + id + "p\">" +
                            solid(faces_of_box(""), "2") +
                            "</bldg:BuildingPart></bldg:consistsOfBuildingPart>");
  };
  folder.write("a.gml", city_model(with_part("x")));
  folder.write("deeper/b.gml", city_model(with_part("y")));
  const Scene scene = read(folder.path(), without_ground());
  ASSERT_EQ(scene.objects.size(), 4U);
  EXPECT_EQ(scene.objects[3].id, "yp");
  EXPECT_EQ(scene.objects[3].parent, 2U);
  EXPECT_EQ(scene.surfaces.object[11], 3U);
}

TEST(CityFolder, TilesOfOtherPlacesAndEmptyFoldersAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(read(folder.path()), InputError);
  folder.write("a.gml", city_model(box_building()));
  folder.write("b.gml", city_model(box_building(), "2.0", "urn:ogc:def:crs:EPSG::25832"));
  try {
    read(folder.path());
    FAIL() << "was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("b.gml"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace tenku
