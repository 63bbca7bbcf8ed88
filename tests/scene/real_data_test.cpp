// Counts against the manifest of the data folder, which was made with other programs.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <ostream>

#include "core/error.h"
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
        Expected{"city/citygml/denhaag_tile01_citygml1.gml.gz", 2498, 41187, "", "EPSG:28992"},
        Expected{"city/citygml/bavaria_4424_5482_lod2_solids.gml", 111, 3530, "", "EPSG:31468"},
        Expected{"city/citygml/munich_752bld_lod2_citygml3.gml.gz", 752, 50807, "", "EPSG:31468"},
        Expected{"city/citygml/jefferson_building_lod1_citygml3.gml", 1, 488, "", "EPSG:4979"},
        Expected{"city/plateau/523965_dem_6697_yokosuka.gml", 2, 1066, "", "EPSG:6697"},
        Expected{"city/plateau/53392633_bldg_6697_haneda.gml", 10, 4604, "", "EPSG:6697"},
        Expected{"city/plateau/53392633_bldg_6697_haneda.gml", 10, 656, "1", "EPSG:6697"},
        Expected{"city/plateau/53392633_bldg_6697_haneda.gml", 10, 154, "0", "EPSG:6697"},
        Expected{"city/plateau/54363371_bldg_6697_komatsu.gml", 192, 4544, "1", "EPSG:6697"},
        Expected{"city/3dtiles/wageningen/7-624-528/content/3_6_7.glb", 145, 6777, "", ""},
        Expected{"city/3dtiles/wageningen/7-624-528/content/3_7_7.glb", 81, 5432, "", ""},
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

TEST(RealDataDefects, OfCityGmlAreThoseOfTheManifest) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "TENKU_DATA does not name the folder of real data";
  const Scene hague = read(*folder / "city/citygml/denhaag_tile01_citygml1.gml.gz");
  EXPECT_EQ(count_of(hague, "nonplanar_over_1cm") + count_of(hague, "nonplanar_over_10cm"), 281U);
  EXPECT_EQ(count_of(hague, "nonplanar_over_10cm"), 19U);
  EXPECT_EQ(count_of(hague, "self_intersecting_ring"), 4U);
  EXPECT_EQ(count_of(hague, "open_shell") + count_of(hague, "unresolved_xlink"), 0U);
  EXPECT_TRUE(hague.has_terrain);
  const Scene opera = read(*folder / "city/citygml/opera_lyon_lod2_citygml3.gml.gz");
  EXPECT_EQ(count_of(opera, "ring_not_closed"), 8U);
  const Scene jefferson = read(*folder / "city/citygml/jefferson_building_lod1_citygml3.gml");
  EXPECT_EQ(count_of(jefferson, "inverted_shell"), 1U);
  // The registry has latitude first; the file does not keep to it, nor name its system formally.
  EXPECT_NEAR(jefferson.georeference->origin.latitude.in_degrees(), 38.888649, 1e-3);
  const Scene damaged = read(*folder / "city/plateau/defect_L13_53392633.gml.gz");
  EXPECT_EQ(count_of(damaged, "unresolved_xlink"), 1U);
  EXPECT_GT(count_of(damaged, "misplaced_surface"), 0U);
}

TEST(RealDataDefects, FileWhoseSystemDoesNotExistIsRefused) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "TENKU_DATA does not name the folder of real data";
  const auto file = *folder / "city/plateau/defect_C01_C04_L05_L06_L07_L11_L13_T03_53392633.gml.gz";
  EXPECT_THROW(read(file), InputError);
  ReadOptions options;
  options.crs = "EPSG:6697";
  const Scene scene = read(file, options);
  EXPECT_EQ(count_of(scene, "ring_not_closed"), 2U);
}

/// Area and volume of each object, by its id.
std::map<std::string, Measures> measures_by_object(const Scene& scene) {
  const TriangleSoup soup = flatten(scene);
  std::map<std::string, Measures> result;
  for (std::size_t t = 0; t < soup.size(); ++t) {
    const auto& corner = soup.triangles[t];
    const Vec3 a = soup.vertices[corner[0]], b = soup.vertices[corner[1]],
               c = soup.vertices[corner[2]];
    Measures& sum = result[scene.objects[soup.object[t]].id];
    sum.area += 0.5 * length(cross(b - a, c - a));
    sum.volume += dot(a, cross(b, c)) / 6.0;
  }
  return result;
}

/// @param sliver_m2  by which areas of small objects may differ
void expect_same_objects(const Scene& one, const Scene& other, double share, double sliver_m2) {
  const auto first = measures_by_object(one), second = measures_by_object(other);
  ASSERT_EQ(first.size(), second.size());
  for (const auto& [id, sum] : first) {
    const auto found = second.find(id);
    ASSERT_NE(found, second.end()) << id;
    EXPECT_NEAR(found->second.area, sum.area, share * sum.area + sliver_m2) << id;
  }
}

std::array<std::size_t, kSurfaceTypes> types_of(const Scene& scene) {
  std::array<std::size_t, kSurfaceTypes> counts{};
  for (const SurfaceType type : scene.surfaces.type) ++counts[static_cast<std::size_t>(type)];
  return counts;
}

// One tile, published in both encodings; coordinates of the JSON are rounded to a millimetre, so
// that a metre of edge moves by up to 7 cm2.
TEST(RealDataFormats, HagueIsTheSameInCityGmlAndCityJson) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "TENKU_DATA does not name the folder of real data";
  const Scene gml = read(*folder / "city/citygml/denhaag_tile01_citygml1.gml.gz", without_ground());
  const Scene json = read(*folder / "city/cityjson/denhaag_tile01_v10.city.json", without_ground());
  EXPECT_EQ(types_of(gml), types_of(json));
  EXPECT_EQ(gml.lod_triangles, json.lod_triangles);
  expect_same_objects(gml, json, 2e-3, 0.02);
}

/// Triangles all of whose edges are longer than a millimetre: the manifest takes corners closer
/// than that for one.
std::size_t triangles_without_slivers(const Scene& scene) {
  const TriangleSoup soup = flatten(scene);
  const auto is_short = [&](std::uint32_t a, std::uint32_t b) {
    return length(soup.vertices[a] - soup.vertices[b]) < 1.5e-4;
  };
  return static_cast<std::size_t>(
      std::count_if(soup.triangles.begin(), soup.triangles.end(), [&](const auto& t) {
        return !is_short(t[0], t[1]) && !is_short(t[1], t[2]) && !is_short(t[2], t[0]);
      }));
}

// One building of Tokyo, converted from CityGML 2.0 to 3.0 by others.
TEST(RealDataFormats, TokyoIsTheSameInBothVersionsOfCityGml) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "TENKU_DATA does not name the folder of real data";
  const auto plateau = *folder / "city/plateau";
  for (const char* lod : {"0", "1", "2"}) {
    ReadOptions options = without_ground();
    options.building_lod = lod;
    const Scene second = read(plateau / "53394517_bldg_6697_citygml2.gml", options);
    const Scene third = read(plateau / "53394517_bldg_6697_citygml3.gml", options);
    EXPECT_EQ(types_of(second), types_of(third));
    expect_same_objects(second, third, 1e-9, 0.0);
    const std::map<std::string, std::size_t> manifest{{"0", 126}, {"1", 508}, {"2", 2186}};
    EXPECT_EQ(triangles_without_slivers(third), manifest.at(lod));
  }
}

TEST(RealDataFormats, RadianceOfficeHasThePolygonsOfTheManifest) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "TENKU_DATA does not name the folder of real data";
  for (const auto& [name, polygons] : std::map<std::string, std::size_t>{{"desks", 5840},
                                                                         {"cubefabric", 5040},
                                                                         {"cubeframe", 2771},
                                                                         {"extwalls", 58},
                                                                         {"walls", 61},
                                                                         {"windowframe", 168},
                                                                         {"lower_glass", 4},
                                                                         {"floor", 1}}) {
    const Scene scene = read(*folder / "interior/frads_office/Objects" / (name + ".rad"));
    EXPECT_EQ(scene.surfaces.size() + count_of(scene, "zero_area_face"), polygons) << name;
    EXPECT_EQ(count_of(scene, "self_intersecting_ring"), 0U) << name;
  }
}

TEST(RealDataFormats, FolderOfTilesIsOneCity) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "TENKU_DATA does not name the folder of real data";
  const TemporaryFolder tiles;
  for (const char* name : {"53392633_bldg_6697_haneda.gml", "53394517_bldg_6697_citygml2.gml"}) {
    std::filesystem::create_symlink(*folder / "city/plateau" / name, tiles.path() / name);
  }
  ReadOptions options = without_ground();
  options.building_lod = "1";
  const Scene city = read(tiles.path(), options);
  EXPECT_EQ(city.objects.size(), 11U);
  EXPECT_EQ(triangles_without_slivers(city), 656U + 508U);
  EXPECT_EQ(city.lod_triangles.at("2"), 4604U + 2186U);
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
