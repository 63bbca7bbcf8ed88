// Terrain from GeoTIFF. The files are made here byte by byte, without GDAL, after TIFF 6.0 and
// OGC GeoTIFF 1.1.
#include <gtest/gtest.h>

#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/error.h"
#include "scene/georeference.h"
#include "tests/scene/citygml_texts.h"

namespace tenku {
namespace {

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// A little-endian TIFF of one strip: tags in ascending order, what is long behind them.
class TinyTiff {
 public:
  template <class T>
  void tag(std::uint16_t number, std::uint16_t type, const std::vector<T>& values) {
    entries_.push_back({number, type, static_cast<std::uint32_t>(values.size()), bytes_of(values)});
  }

  std::string bytes(const std::string& pixels) {
    const auto count = static_cast<std::uint16_t>(entries_.size());
    const std::uint32_t data = 8 + 2 + 12U * count + 4;
    std::string tags, far;
    for (Entry& e : entries_) {
      std::string value = e.value;
      if (value.size() > 4) {
        value = bytes_of<std::uint32_t>({data + static_cast<std::uint32_t>(far.size())});
        far += e.value + std::string(e.value.size() % 2, '\0');
      }
      if (e.number == 273) pixels_at_ = tags.size() + 8;
      value.resize(4, '\0');
      tags +=
          bytes_of<std::uint16_t>({e.number, e.type}) + bytes_of<std::uint32_t>({e.count}) + value;
    }
    const auto pixels_from = data + static_cast<std::uint32_t>(far.size());
    tags.replace(pixels_at_, 4, bytes_of<std::uint32_t>({pixels_from}));
    return std::string("II") + bytes_of<std::uint16_t>({42}) + bytes_of<std::uint32_t>({8}) +
           bytes_of<std::uint16_t>({count}) + tags + std::string(4, '\0') + far + pixels;
  }

 private:
  struct Entry {
    std::uint16_t number, type;
    std::uint32_t count;
    std::string value;
  };
  std::vector<Entry> entries_;
  std::size_t pixels_at_ = 0;
};

using Shorts = std::vector<std::uint16_t>;

// EPSG:8228 and 6360: heights of one datum in feet and in US survey feet.
constexpr std::uint16_t kNavd88Feet = 8228, kNavd88SurveyFeet = 6360;

/// 3 by 2 pixels of 10 m, without a reference system if `epsg` is 0, whose north-west corner is at
/// `west`, `north`.
std::string elevation_model(const std::vector<float>& z, std::uint16_t epsg, double west,
                            double north, std::uint16_t vertical_unit = 0) {
  constexpr std::uint16_t kShort = 3, kLong = 4, kAscii = 2, kDouble = 12;
  TinyTiff tiff;
  tiff.tag(256, kShort, Shorts{3});
  tiff.tag(257, kShort, Shorts{2});
  tiff.tag(258, kShort, Shorts{32});
  tiff.tag(259, kShort, Shorts{1});
  tiff.tag(262, kShort, Shorts{1});
  tiff.tag(273, kLong, std::vector<std::uint32_t>{0});
  tiff.tag(277, kShort, Shorts{1});
  tiff.tag(278, kShort, Shorts{2});
  tiff.tag(279, kLong, std::vector<std::uint32_t>{24});
  tiff.tag(339, kShort, Shorts{3});
  tiff.tag(33550, kDouble, std::vector<double>{10, 10, 0});
  tiff.tag(33922, kDouble, std::vector<double>{0, 0, 0, west, north, 0});
  Shorts keys{1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, epsg};
  if (vertical_unit != 0) {
    keys[3] = 5;
    for (const std::uint16_t v :
         Shorts{4096, 0, 1, vertical_unit == 9002 ? kNavd88Feet : kNavd88SurveyFeet, 4099, 0, 1,
                vertical_unit}) {
      keys.push_back(v);
    }
  }
  if (epsg != 0) tiff.tag(34735, kShort, keys);
  tiff.tag(42113, kAscii, std::vector<char>{'-', '9', '9', '9', '9', '\0'});
  return tiff.bytes(bytes_of(z));
}

/// Easting, northing, height of the file's pixel centres, as read, by northing then easting.
std::vector<Vec3> map_points(const Scene& scene) {
  std::vector<Vec3> points;
  for (const Vec3 v : scene.vertices) points.push_back(scene.map_frame.to_file(v));
  return points;
}

void expect_point(const std::vector<Vec3>& points, const Vec3 wanted, double tolerance_m) {
  const bool is_there = std::any_of(points.begin(), points.end(), [&](const Vec3 p) {
    return length(p - wanted) <= tolerance_m;
  });
  EXPECT_TRUE(is_there) << wanted.x << ", " << wanted.y << ", " << wanted.z;
}

const std::vector<float> kHeights{1, 2, 3, 4, 5, 6.5F};

TEST(Terrain, HeightsStandAtTheCentresOfPixels) {
  const Scene scene = read_text("dem.tif", elevation_model(kHeights, 28992, 100000, 450000));
  EXPECT_EQ(scene.format, "GeoTIFF");
  EXPECT_EQ(scene.georeference->crs, "EPSG:28992");
  EXPECT_EQ(scene.surfaces.size(), 4U);
  const auto points = map_points(scene);
  ASSERT_EQ(points.size(), 6U);
  expect_point(points, {100005, 449995, 1}, 1e-6);
  expect_point(points, {100025, 449995, 3}, 1e-6);
  expect_point(points, {100005, 449985, 4}, 1e-6);
  expect_point(points, {100025, 449985, 6.5}, 1e-6);
  for (std::size_t s = 0; s < 4; ++s) EXPECT_GT(area_vector(scene, s).z, 0.0);
}

TEST(Terrain, PixelsWithoutDataAreHolesThatAreTold) {
  const Scene scene =
      read_text("dem.tif", elevation_model({-9999, 2, 3, 4, 5, 6}, 28992, 100000, 450000));
  EXPECT_EQ(scene.surfaces.size(), 2U);
  EXPECT_EQ(count_of(scene, "terrain_hole"), 1U);
}

TEST(Terrain, HeightsInFeetBecomeMetres) {
  // 9002 is the foot of EPSG, 0.3048 m; 9003 that of the US survey, 1200/3937 m.
  for (const auto& [unit, metres] : {std::pair{9002, 0.3048}, std::pair{9003, 1200.0 / 3937.0}}) {
    const Scene scene =
        read_text("dem.tif", elevation_model({1000, 2000, 3000, 1000, 2000, 3000}, 28992, 100000,
                                             450000, static_cast<std::uint16_t>(unit)));
    expect_point(map_points(scene), {100025, 449995, 3000.0 * metres}, 1e-6);
  }
}

TEST(Terrain, ACityInAFolderIsSetOnTheTerrainBesideIt) {
  const TemporaryFolder folder;
  folder.write("city.gml", city_model(box_building("house")));
  folder.write("a.tif", elevation_model(kHeights, 28992, 99990, 450010));
  const Scene scene = read(folder.path());
  ASSERT_EQ(scene.objects.size(), 2U);  // no ground of ours
  EXPECT_EQ(scene.objects[1].type, "TINRelief");
  EXPECT_TRUE(scene.has_terrain);
  expect_point(map_points(scene), {99995, 450005, 1}, 1e-6);
}

TEST(Terrain, AnotherReferenceSystemIsBroughtIntoThatOfTheCity) {
  // Amersfoort's fundamental point, (155000, 463000) in EPSG:28992, as the RDNAPTRANS documents
  // have it in ETRS89; UTM by GeographicLib; a datum shift without grids is good to a metre.
  int zone = 0;
  bool is_north = false;
  double easting = 0.0, northing = 0.0;
  GeographicLib::UTMUPS::Forward(52.155172897, 5.387203657, zone, is_north, easting, northing, 31);
  const TemporaryFolder folder;
  folder.write("city.gml", city_model(box_building("house")));
  folder.write("a.tif", elevation_model(kHeights, 25831, easting - 5, northing + 5));
  expect_point(map_points(read(folder.path())), {155000, 463000, 1}, 1.0);
}

// Size, scale and corner are the file's tags 256, 257, 33550 and 33922; heights by inflating the
// strips and summing the differences along the rows (predictor 2) in a few lines of Python.
TEST(Terrain, BilbaosHillsAreRead) {
  const auto data = data_folder();
  if (!data) GTEST_SKIP() << "TENKU_DATA is not set";
  const Scene scene = read(*data / "terrain" / "bilbao_DEM.tif");
  EXPECT_EQ(scene.georeference->crs, "EPSG:25830");
  EXPECT_EQ(scene.vertices.size(), 680U * 680U);
  const auto at = [](double row, double column, double height) {
    return Vec3{499400.0 + 5.001238375576373 * (column + 0.5),
                4797200.0 - 4.99921326714487 * (row + 0.5), height};
  };
  const auto points = map_points(scene);
  expect_point(points, at(0, 0, 6), 1e-6);
  expect_point(points, at(100, 200, 62), 1e-6);
  expect_point(points, at(340, 340, 0), 1e-6);
  expect_point(points, at(679, 679, 9), 1e-6);
  EXPECT_EQ(scene.extent.min.z, -2.0);
  EXPECT_EQ(scene.extent.max.z, 103.0);
  EXPECT_NEAR(scene.extent.min.x, 499400.0 + 5.001238375576373 / 2.0, 1e-6);
  EXPECT_NEAR(scene.extent.max.y, 4797200.0 - 4.99921326714487 / 2.0, 1e-6);
}

TEST(Terrain, AFileWithoutAReferenceSystemIsToldWhereItIsGuessed) {
  const TemporaryFolder folder;
  folder.write("city.gml", city_model(box_building("house")));
  folder.write("a.tif", elevation_model(kHeights, 0, 99990, 450010));
  const Scene scene = read(folder.path());
  EXPECT_EQ(count_of(scene, "terrain_without_crs"), 1U);
  expect_point(map_points(scene), {99995, 450005, 1}, 1e-6);
}

TEST(Terrain, BrokenFilesAreRefused) {
  const std::string whole = elevation_model(kHeights, 28992, 100000, 450000);
  for (const std::size_t bytes : {0, 8, 100, 200}) {
    EXPECT_THROW(read_text("dem.tif", whole.substr(0, bytes)), InputError) << bytes;
  }
  EXPECT_THROW(read_text("dem.tif", whole.substr(0, whole.size() - 4)), InputError);
}

}  // namespace
}  // namespace tenku
