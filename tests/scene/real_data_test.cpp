// Counts against the manifest of the data folder, which was made with other programs.
#include <gtest/gtest.h>

#include <ostream>

#include "tests/scene/scene_files.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

struct Expected {
  const char* file;
  std::size_t objects, triangles;  ///< of the LOD used
  const char* lod;
  const char* crs;

  friend void PrintTo(const Expected& e, std::ostream* out) { *out << e.file << " LOD " << e.lod; }
};

class RealData : public testing::TestWithParam<Expected> {};

TEST_P(RealData, CountsAreThoseOfTheManifest) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "TENKU_DATA does not name the folder of real data";
  ReadOptions options = without_ground();
  options.building_lod = GetParam().lod;
  const Scene scene = read(*folder / GetParam().file, options);
  const TriangleSoup soup = flatten(scene);
  EXPECT_EQ(scene.objects.size(), GetParam().objects);
  EXPECT_EQ(soup.size() + count_of(scene, "zero_area_face"), GetParam().triangles);
  EXPECT_EQ(scene.georeference ? scene.georeference->crs : "", GetParam().crs);
  for (const Vec3 v : soup.vertices) ASSERT_TRUE(is_finite(v));
}

INSTANTIATE_TEST_SUITE_P(
    Files, RealData,
    testing::Values(
        Expected{"city/cityjson/denhaag_tile01_v10.city.json", 2498, 41187, "", "EPSG:7415"},
        Expected{"city/cityjson/denhaag_4buildings_v11.city.json", 12, 148, "", ""},
        Expected{"city/cityjson/delft_lod1_all_objects.city.json", 570, 36271, "", "EPSG:7415"},
        Expected{"city/cityjson/delft_1building.city.json", 1, 229, "", "EPSG:7415"},
        Expected{"city/cityjson/delft_subset.city.jsonl", 20, 420, "", "EPSG:7415"},
        Expected{"city/cityjson/delft_subset.city.jsonl", 20, 192, "1.2", "EPSG:7415"},
        Expected{"city/cityjson/3dbag_multi_lod.city.json", 10, 180, "1.2", ""},
        Expected{"city/cityjson/3dbag_multi_lod.city.json", 10, 224, "1.3", ""},
        Expected{"city/cityjson/3dbag_multi_lod.city.json", 10, 224, "1", ""},
        Expected{"city/cityjson/3dbag_multi_lod.city.json", 10, 348, "2.2", ""},
        Expected{"city/cityjson/rotterdam_one_v11.city.json", 1, 29, "", "EPSG:7415"},
        Expected{"city/cityjson/rotterdam_subset.city.json", 16, 622, "", ""},
        Expected{"city/cityjson/zurich_subset_lod2_v11.city.json", 210, 5142, "", "EPSG:2056"},
        Expected{"city/cityjson/japanese_attributes.city.json", 4, 406, "2", "EPSG:6677"},
        Expected{"city/large/tokyo_minato_north_lod1.city.json.gz", 14831, 396544, "", "EPSG:6677"},
        Expected{"city/large/linz_centre_lod2.obj.gz", 11226, 619999, "", "EPSG:31255"}));

TEST(RealDataDefects, AreThoseOfTheManifest) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "TENKU_DATA does not name the folder of real data";
  const Scene hague = read(*folder / "city/cityjson/denhaag_tile01_v10.city.json");
  EXPECT_EQ(count_of(hague, "nonplanar_over_1cm") + count_of(hague, "nonplanar_over_10cm"), 280U);
  EXPECT_EQ(count_of(hague, "nonplanar_over_10cm"), 19U);
  EXPECT_EQ(count_of(hague, "self_intersecting_ring"), 4U);
  EXPECT_EQ(count_of(hague, "open_shell"), 0U);
  EXPECT_TRUE(hague.has_terrain);
  const Scene rotterdam = read(*folder / "city/cityjson/rotterdam_delfshaven_v10.city.json");
  EXPECT_EQ(count_of(rotterdam, "degenerate_ring"), 633U);
  EXPECT_EQ(rotterdam.objects.size(), 853U + 1U);  // and the ground
  const Scene japan = read(*folder / "city/cityjson/japanese_attributes.city.json");
  EXPECT_EQ(count_of(japan, "inverted_shell"), 4U);
  const Scene delft = read(*folder / "city/cityjson/delft_lod1_all_objects.city.json");
  EXPECT_EQ(count_of(delft, "open_shell"), 160U);
  const Scene linz = read(*folder / "city/large/linz_centre_lod2.obj.gz");
  EXPECT_EQ(count_of(linz, "duplicate_vertices"), 190U);
}

// 4 faces of Zurich's roofs have one inner ring each: the triangles must not cover the holes.
TEST(RealDataHoles, TriangulationHasTheAreaOfThePolygons) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "TENKU_DATA does not name the folder of real data";
  const Scene scene =
      read(*folder / "city/cityjson/zurich_subset_lod2_v11.city.json", without_ground());
  double polygons = 0.0;
  std::size_t holes = 0;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    polygons += length(area_vector(scene, s));
    holes += scene.surfaces.rings(s) - 1;
  }
  EXPECT_EQ(holes, 4U);
  EXPECT_NEAR(measures(flatten(scene)).area, polygons, 1e-4 * polygons);
}

}  // namespace
}  // namespace tenku
