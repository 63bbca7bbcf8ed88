/// GeoTIFFs of heights, made byte by byte, without GDAL, after TIFF 6.0 and OGC GeoTIFF 1.1.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace tenku {

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
inline constexpr std::uint16_t kNavd88Feet = 8228, kNavd88SurveyFeet = 6360;

/// Pixels of an elevation model, from the north-west corner of the first.
struct Raster {
  double west, north;
  std::uint16_t columns = 3, rows = 2;
  double pixel = 10.0;
};

/// @param epsg  0: without a reference system
inline std::string elevation_model(const std::vector<float>& z, std::uint16_t epsg,
                                   const Raster& raster, std::uint16_t vertical_unit = 0) {
  constexpr std::uint16_t kShort = 3, kLong = 4, kAscii = 2, kDouble = 12;
  TinyTiff tiff;
  tiff.tag(256, kShort, Shorts{raster.columns});
  tiff.tag(257, kShort, Shorts{raster.rows});
  tiff.tag(258, kShort, Shorts{32});
  tiff.tag(259, kShort, Shorts{1});
  tiff.tag(262, kShort, Shorts{1});
  tiff.tag(273, kLong, std::vector<std::uint32_t>{0});
  tiff.tag(277, kShort, Shorts{1});
  tiff.tag(278, kShort, Shorts{raster.rows});
  tiff.tag(279, kLong, std::vector<std::uint32_t>{4U * raster.columns * raster.rows});
  tiff.tag(339, kShort, Shorts{3});
  tiff.tag(33550, kDouble, std::vector<double>{raster.pixel, raster.pixel, 0});
  tiff.tag(33922, kDouble, std::vector<double>{0, 0, 0, raster.west, raster.north, 0});
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

}  // namespace tenku
