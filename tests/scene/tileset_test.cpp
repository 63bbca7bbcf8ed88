// 3D Tiles: explicit, implicit, external; where the tiles stand on Earth.
#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <set>

#include "core/error.h"
#include "tests/scene/gltf_texts.h"
#include "tests/scene/scene_files.h"
#include "tests/scene/tile_texts.h"

namespace tenku {
namespace {

/// Column-major matrix that puts x east, y north, z up at a place on the ellipsoid.
std::string standing_at(double latitude, double longitude, double height) {
  double x = 0.0, y = 0.0, z = 0.0;
  std::vector<double> rows(9);
  GeographicLib::Geocentric::WGS84().Forward(latitude, longitude, height, x, y, z, rows);
  std::ostringstream text;
  text.precision(17);
  for (std::size_t column = 0; column < 3; ++column) {
    for (std::size_t row = 0; row < 3; ++row) text << rows[3 * row + column] << ',';
    text << "0,";
  }
  text << x << ',' << y << ',' << z << ",1";
  return R"("transform":[)" + text.str() + "]";
}

const std::string kTile = R"("geometricError":1,"boundingVolume":{"region":[0,0,0,0,0,0]})";

std::string tileset(const std::string& root) {
  return R"({"asset":{"version":"1.1"},"geometricError":1,"root":{)" + kTile + "," + root + "}}";
}

TEST(Tileset, TileStandsWhereItsTransformPutsIt) {
  const TemporaryFolder folder;
  folder.write("box.glb", glb());
  const Scene scene = read(folder.write("tileset.json", tileset(standing_at(43.06, 141.35, 20.0) +
                                                                R"(,"content":{"uri":"box.glb"})")),
                           without_ground());
  EXPECT_EQ(scene.format, "3D Tiles 1.1");
  ASSERT_TRUE(scene.georeference);
  EXPECT_EQ(scene.georeference->crs, "EPSG:4979");
  EXPECT_NEAR(scene.georeference->origin.latitude.in_degrees(), 43.06, 1e-4);
  EXPECT_NEAR(scene.georeference->origin.longitude.in_degrees(), 141.35, 1e-4);
  EXPECT_TRUE(scene.is_city);
  const TriangleSoup soup = flatten(scene);
  const Measures box = measures(soup);
  // Lengths of the local frame are those on the ellipsoid: h / R = 3e-6 off at 20 m.
  EXPECT_NEAR(box.volume, 60.0, 60.0 * 3e-5);
  EXPECT_NEAR(box.area, 94.0, 94.0 * 3e-5);
  EXPECT_NEAR(scene.extent.min.z, 20.0, 1e-5);
  EXPECT_NEAR(scene.extent.max.z, 25.0, 1e-5);
  // The box has its long side (4 m) to the east and its top up.
  Extent local;
  for (const Vec3 v : scene.vertices) local.add(v);
  EXPECT_NEAR(local.max.x - local.min.x, 4.0, 1e-3);
  EXPECT_NEAR(local.max.y - local.min.y, 3.0, 1e-3);
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const Vec3 n = normalized(area_vector(scene, s));
    EXPECT_TRUE(std::abs(n.z) < 1e-5 || std::abs(n.z) > 1.0 - 1e-5);
  }
}

TEST(Tileset, FinerTilesTakeThePlaceOfCoarserOnesOrJoinThem) {
  const TemporaryFolder folder;
  folder.write("a.glb", glb());
  folder.write("b.glb", glb());
  const auto surfaces = [&](const std::string& refine) {
    return read(
               folder.write("tileset.json", tileset(R"("refine":")" + refine +
                                                    R"(","content":{"uri":"a.glb"},"children":[{)" +
                                                    kTile + R"(,"content":{"url":"b.glb"}}])")))
        .surfaces.size();
  };
  EXPECT_EQ(surfaces("REPLACE"), 12U);
  EXPECT_EQ(surfaces("ADD"), 24U);
}

TEST(Tileset, ExternalTilesetsAreFollowedAndMissingTilesTold) {
  const TemporaryFolder folder;
  folder.write("box.glb", glb());
  folder.write("inner.json", tileset(R"("content":{"uri":"box.glb"})"));
  const Scene scene = read(folder.write(
      "tileset.json", tileset(R"("refine":"ADD","content":{"uri":"inner.json"},"children":[{)" +
                              kTile + R"(,"content":{"uri":"nobody.glb"}}])")));
  EXPECT_EQ(scene.surfaces.size(), 12U);
  EXPECT_EQ(count_of(scene, "missing_tile"), 1U);
  EXPECT_FALSE(scene.georeference);  // local metres, z up
  EXPECT_NEAR(measures(flatten(scene)).volume, 60.0, 1e-4);
  // The folder is the tileset.
  EXPECT_EQ(read(folder.path()).surfaces.size(), 12U);
  // A tileset that names itself ends.
  folder.write("inner.json", tileset(R"("content":{"uri":"inner.json"})"));
  EXPECT_THROW(read(folder.path()), InputError);
}

TEST(Tileset, PointsAndRepeatedModelsAreToldAndCounted) {
  const TemporaryFolder folder;
  const std::string rest(28, '\0');
  folder.write("a.b3dm", b3dm(batched_glb(), "", ""));
  folder.write("b.i3dm", "i3dm" + rest);
  folder.write("c.pnts", "pnts" + rest);
  const auto child = [](const std::string& uri) {
    return "{" + kTile + R"(,"content":{"uri":")" + uri + "\"}}";
  };
  const Scene scene = read(folder.write(
      "tileset.json", tileset(R"("children":[)" + child("a.b3dm") + "," + child("b.i3dm") + "," +
                              child("c.pnts") + "," + child("c.pnts") + "]")));
  EXPECT_EQ(count_of(scene, "ignored_tile"), 3U);
  EXPECT_GE(scene.surfaces.size(), 12U);
}

TEST(Tileset, BatchedModelsGiveTheirFeaturesNames) {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "a.b3dm", b3dm(batched_glb(), R"({"BATCH_LENGTH":2})", R"({"gml_id":["first","second"]})"));
  const Scene scene = read(file);
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.objects[0].id, "first");
  EXPECT_EQ(scene.objects[1].id, "second");
  EXPECT_EQ(scene.surfaces.size(), 12U);
  const Scene unnamed = read(folder.write("b.b3dm", b3dm(batched_glb(), "", "")));
  EXPECT_EQ(unnamed.objects[1].id, "b/1");
}

// A quadtree of two levels in a subtree: the root and its children 1 (x 1, y 0) and 2 (x 0, y 1)
// have contents.
TEST(Tileset, ImplicitTilesAreFoundByTheirAvailability) {
  const TemporaryFolder folder;
  for (const char* name : {"0_0_0.glb", "1_1_0.glb", "1_0_1.glb"}) folder.write(name, glb());
  folder.write("0.0.0.subtree",
               subtree(R"({"buffers":[{"byteLength":1}],"bufferViews":[{"buffer":0,)"
                       R"("byteLength":1}],"tileAvailability":{"constant":1},)"
                       R"("contentAvailability":[{"bitstream":0}],)"
                       R"("childSubtreeAvailability":{"constant":0}})",
                       std::string(1, '\x0d')));  // bits 0, 2, 3: Morton 1 and 2
  const auto read_with = [&](const std::string& refine) {
    return read(folder.write(
        "tileset.json",
        tileset(R"("refine":")" + refine + R"(","content":{"uri":"{level}_{x}_{y}.glb"},)" +
                R"("implicitTiling":{"subdivisionScheme":"QUADTREE","subtreeLevels":2,)"
                R"("availableLevels":2,"subtrees":{"uri":"{level}.{x}.{y}.subtree"}})")));
  };
  const Scene all = read_with("ADD");
  EXPECT_EQ(all.surfaces.size(), 36U);
  EXPECT_EQ(count_of(all, "missing_tile"), 0U);
  EXPECT_EQ(read_with("REPLACE").surfaces.size(), 24U);
}

// The manifest's counts. Buildings of the LOD1 tile are prisms: their walls stand upright only if
// tile, axes and centre are put together in the right order.
TEST(Tileset, RealTilesAreRead) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "TENKU_DATA does not name the folder of real data";
  const Scene minato = read(*folder / "city/3dtiles/minato_draco/data108.b3dm", without_ground());
  EXPECT_EQ(flatten(minato).size() + count_of(minato, "zero_area_face"), 788U);
  EXPECT_EQ(minato.objects.size(), 16U);
  ASSERT_TRUE(minato.georeference);
  EXPECT_NEAR(minato.georeference->origin.latitude.in_degrees(), 35.65, 0.05);
  EXPECT_NEAR(minato.georeference->origin.longitude.in_degrees(), 139.75, 0.05);
  double upright = 0.0, level = 0.0, all = 0.0;
  for (std::size_t s = 0; s < minato.surfaces.size(); ++s) {
    const Vec3 n = area_vector(minato, s);
    const double slope = std::abs(n.z) / length(n);
    all += length(n);
    if (slope < 0.01) upright += length(n);
    if (slope > 0.9999) level += length(n);
  }
  EXPECT_GT((upright + level) / all, 0.99);
  EXPECT_GT(minato.extent.min.z, 0.0);
  EXPECT_LT(minato.extent.max.z, 400.0);

  const Scene wageningen = read(*folder / "city/3dtiles/wageningen/7-624-528", without_ground());
  // The sum of the manifest's triangles of the 13 tiles.
  EXPECT_EQ(wageningen.surfaces.size() + count_of(wageningen, "zero_area_face"), 146666U);
  EXPECT_NEAR(wageningen.georeference->origin.latitude.in_degrees(), 51.97, 0.02);
  EXPECT_NEAR(wageningen.georeference->origin.longitude.in_degrees(), 5.63, 0.03);
  EXPECT_EQ(count_of(wageningen, "missing_tile"), 0U);
}

}  // namespace
}  // namespace tenku
