/// Pictures: physical values, and what a screen shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/rgb.h"

namespace tenku {

/// Place in a picture: (0, 0) is the upper left corner of the upper left pixel, x to the right,
/// y down, in pixels. The centre of the first pixel is (0.5, 0.5).
struct PixelPosition {
  double x = 0.0, y = 0.0;
};

/// Picture of physical values.
///
/// Units    whatever the maker states; luminance pictures hold cd/m2 in linear Rec. 709 RGB.
/// Shape    [row][column], row-major; row 0 is the top.
struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;

  Image() = default;
  Image(int columns, int rows, Rgb fill = {})
      : width(columns),
        height(rows),
        pixels(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), fill) {}

  Rgb& at(int column, int row) { return pixels[index_of(column, row)]; }
  Rgb at(int column, int row) const { return pixels[index_of(column, row)]; }

 private:
  std::size_t index_of(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
};

/// Colour of a screen: sRGB, 8 bits a channel.
struct Rgb8 {
  std::uint8_t r = 0, g = 0, b = 0;
  friend constexpr bool operator==(Rgb8, Rgb8) = default;
};

/// Picture for a screen or a page, sRGB.
///
/// Shape    [row][column], row-major; row 0 is the top.
struct Image8 {
  int width = 0, height = 0;
  std::vector<Rgb8> pixels;

  Image8() = default;
  Image8(int columns, int rows, Rgb8 fill = {255, 255, 255})
      : width(columns),
        height(rows),
        pixels(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), fill) {}

  Rgb8& at(int column, int row) { return pixels[index_of(column, row)]; }
  Rgb8 at(int column, int row) const { return pixels[index_of(column, row)]; }

 private:
  std::size_t index_of(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
};

}  // namespace tenku
