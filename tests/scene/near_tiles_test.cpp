// Which tiles of a city are read about a place, and how.
#include "scene/near_tiles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "scene/terrain.h"
#include "tests/scene/citygml_texts.h"
#include "tests/scene/scene_files.h"

namespace tenku {
namespace {

/// A block of 10 m by 10 m, so high at LOD 2, and 1 m higher at LOD 1.
std::string block(const std::string& id, double x, double y, int height) {
  std::string text =
      R"({"type":"CityJSON","version":"2.0","metadata":{"referenceSystem":)"
      R"("https://www.opengis.net/def/crs/EPSG/0/7415"},"transform":{"scale":[1,1,1],)"
      R"("translate":[$x,$y,0]},"CityObjects":{"$id":{"type":"Building","geometry":[)"
      R"({"type":"Solid","lod":"2","boundaries":[[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],)"
      R"([[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]]},)"
      R"({"type":"Solid","lod":"1","boundaries":[[[[0,3,2,1]],[[8,9,10,11]],[[0,1,9,8]],)"
      R"([[1,2,10,9]],[[2,3,11,10]],[[3,0,8,11]]]]}]}},"vertices":[[0,0,0],[10,0,0],[10,10,0],)"
      R"([0,10,0],[0,0,$low],[10,0,$low],[10,10,$low],[0,10,$low],[0,0,$high],[10,0,$high],)"
      R"([10,10,$high],[0,10,$high]]})";
  const auto put = [&](const std::string& name, const std::string& value) {
    for (std::size_t at = 0; (at = text.find(name)) != std::string::npos;) {
      text.replace(at, name.size(), value);
    }
  };
  put("$x", std::to_string(x)), put("$y", std::to_string(y)), put("$id", id);
  put("$low", std::to_string(height)), put("$high", std::to_string(height + 1));
  return text;
}

/// The same place as CityJSONSeq without an extent.
std::string sequence(const std::string& id, double x, double y) {
  std::string text = block(id, x, y, 20);
  const std::size_t objects = text.find(",\"CityObjects\"");
  const std::string header = text.substr(0, objects) + R"(,"CityObjects":{},"vertices":[]})";
  return header + "\n" + R"({"type":"CityJSONFeature","id":")" + id + "\"" + text.substr(objects) +
         "\n";
}

TileHead tile(Vec3 low, Vec3 high) { return {Extent{low, high}, "", false}; }

TEST(NearTiles, AreThoseThatRiseOverTheHorizon) {
  ReadOptions options;
  options.tolerance_pct = 2.0;
  const double angle = 0.1 * 0.02 * kPi / 4.0;  // what takes a tenth of 2 % from a wall
  EXPECT_NEAR(skyline_angle(2.0), angle, 1e-15);
  const double of_20_m = 20.0 / angle, of_3_m = 3.0 / angle;
  const PlaceLookedAt place{0, 0, 100};
  const double edge = std::sqrt(2.0) * 100.0;  // corners of the place
  const std::vector<TileHead> tiles{
      tile({-500, -500, 5}, {500, 500, 30}),
      tile({edge + of_3_m - 1, 0, 5}, {9e4, 500, 25}),                  // nearer than 3 m matter
      tile({edge + of_3_m + 1, 0, 5}, {9e4, 500, 25}),                  // further
      tile({edge + of_20_m - 1, 0, 5}, {9e4, 500, 25}),                 // 20 m just matter
      tile({edge + of_20_m + 1, 0, 5}, {9e4, 500, 25}),                 // just not
      tile({-9e4, 0, 900}, {-edge - of_20_m - 1, 500, 1200}),           // but a mountain does
      tile({-500, 5000, -90}, {500, 6000, 5 + 0.9 * 5 * angle * 1e3}),  // flat land
      {std::nullopt, "", false}};
  const TileChoice choice = choose_tiles(tiles, place, options);
  using enum TileUse;
  const std::vector<TileUse> wanted{Whole, Whole, Coarse, Coarse, Out, Coarse, Out, Whole};
  EXPECT_EQ(choice.use, wanted);
  EXPECT_NEAR(choice.coarse_m, of_3_m, 1e-9);
  options.tolerance_pct = 1.0;  // all limits are twice as far
  EXPECT_EQ(choose_tiles(tiles, place, options).use,
            (std::vector<TileUse>{Whole, Whole, Whole, Coarse, Coarse, Coarse, Coarse, Whole}));
}

TEST(NearTiles, InDegreesAreAsFarAsInMetres) {
  ReadOptions options;
  options.crs = "EPSG:6697";
  const double north = 2.0 / 111.32, east = north / std::cos(35.0 * kPi / 180.0);  // 2 km
  const PlaceLookedAt place{35.0, 139.0, 10};
  const std::vector<TileHead> tiles{tile({34.999, 138.999, 0}, {35.001, 139.001, 9}),
                                    tile({35.0, 139.0 + 0.9 * east, 0}, {35.1, 139.1, 9}),
                                    tile({35.0, 139.0 + 1.1 * east, 0}, {35.1, 139.1, 9}),
                                    tile({35.0 + 0.9 * north, 139.0, 0}, {35.1, 139.1, 9}),
                                    tile({35.0 + 1.1 * north, 139.0, 0}, {35.1, 139.1, 9})};
  using enum TileUse;
  EXPECT_EQ(choose_tiles(tiles, place, options).use,
            (std::vector<TileUse>{Whole, Whole, Coarse, Whole, Coarse}));
}

TEST(NearTiles, OfAFolderAreReadAndTheOthersTold) {
  const TemporaryFolder folder;
  folder.write("a.city.json", block("here", 85000, 447000, 20));
  folder.write("b.city.json", block("near", 85500, 447000, 20));
  folder.write("c.city.json", block("far", 88000, 447000, 20));
  folder.write("d.city.json", block("beyond", 85000, 462000, 20));
  folder.write("e.city.jsonl", sequence("untold", 85000, 470000));
  ReadOptions options = without_ground();
  options.around = PlaceLookedAt::parse("85005,447005,50");
  const Scene scene = read(folder.path(), options);
  ASSERT_EQ(scene.objects.size(), 4U);
  EXPECT_EQ(scene.objects[0].id, "here");
  EXPECT_EQ(scene.objects[1].id, "near");
  EXPECT_EQ(scene.objects[2].id, "untold");
  EXPECT_EQ(scene.objects[3].id, "far");
  EXPECT_EQ(count_of(scene, "tiles_left_out"), 1U);
  EXPECT_EQ(count_of(scene, "tiles_coarse"), 1U);
  const auto lod_of = [&](std::uint32_t object) {
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
      if (scene.surfaces.object[s] == object) return scene.lods[scene.surfaces.lod[s]];
    }
    return std::string();
  };
  EXPECT_EQ(lod_of(1), "2");
  EXPECT_EQ(lod_of(3), "1");
  options.around.reset();
  EXPECT_EQ(read(folder.path(), options).objects.size(), 5U);
}

TEST(NearTiles, EnvelopesOfCityGmlAreBelieved) {
  const TemporaryFolder folder;
  const auto with_envelope = [](const std::string& model, const std::string& envelope) {
    const std::size_t begin = model.find("<gml:lowerCorner>"), end = model.find("</gml:Envelope>");
    return model.substr(0, begin) + envelope + model.substr(end);
  };
  const std::string model = city_model(box_building(), "2.0", "EPSG:7415");
  const auto head = [&](const std::string& text) {
    Progress silent;
    return head_of_citygml(folder.write("t.gml", text), silent);
  };
  const TileHead told = head(with_envelope(model,
                                           "<gml:lowerCorner>1 2.5 3</gml:lowerCorner>"
                                           "<gml:upperCorner>4e1 50 60</gml:upperCorner>"));
  ASSERT_TRUE(told.box);
  EXPECT_EQ(told.box->min.y, 2.5);
  EXPECT_EQ(told.box->max.x, 40.0);
  EXPECT_EQ(told.box->max.z, 60.0);
  EXPECT_EQ(told.crs, "EPSG:7415");
  const std::string flat =
      "<gml:lowerCorner>1 2</gml:lowerCorner><gml:upperCorner>4 5</gml:upperCorner>";
  EXPECT_FALSE(head(with_envelope(model, flat)).box);
  EXPECT_FALSE(head(with_envelope(model, "")).box);
  EXPECT_FALSE(head("<no").box);
}

TEST(NearTiles, WrongPlacesAreRefused) {
  const TemporaryFolder folder;
  folder.write("a.city.json", block("here", 85000, 447000, 20));
  ReadOptions options;
  options.around = PlaceLookedAt::parse("95000,447000,50");
  EXPECT_THROW(read(folder.path(), options), InputError);
  for (const char* text : {"", "1,2", "1,2,3,4", "1,2,x", "1,2,0", "1,2,-3", "1,,3", "nan,1,2"}) {
    EXPECT_THROW(PlaceLookedAt::parse(text), InputError) << text;
  }
}

}  // namespace
}  // namespace tenku
