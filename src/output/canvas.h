/// A sheet to draw maps on: filled shapes, lines and text, without jagged edges.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "view/image.h"

namespace tenku {

enum class TextAlign { Left, Centre, Right };

/// How text looks.
struct TextStyle {
  double size = 14.0;  ///< em in pixels; capitals are 0.7 of it high
  Rgb8 colour{32, 36, 40};
  bool bold = false;
  TextAlign align = TextAlign::Left;
};

/// How a line looks. Ends and corners are round.
struct LineStyle {
  double width = 1.0;  ///< pixels
  Rgb8 colour{32, 36, 40};
  double opacity = 1.0;  ///< 0 to 1
};

/// Raster drawing in sRGB.
///
/// Frame    pixels; (0, 0) is the upper left corner of the sheet, y down. What lies outside the
///          sheet is cut off.
class Canvas {
 public:
  Canvas(int width, int height, Rgb8 background = {255, 255, 255});

  /// Fills the inside of `ring`, by the even-odd rule.
  void fill(std::span<const PixelPosition> ring, Rgb8 colour, double opacity = 1.0);

  /// Fills the rectangle between two corners.
  void fill_box(PixelPosition from, PixelPosition to, Rgb8 colour, double opacity = 1.0);

  void line(std::span<const PixelPosition> points, const LineStyle& style);

  /// Outline of the rectangle between two corners.
  void box(PixelPosition from, PixelPosition to, const LineStyle& style);

  /// Writes UTF-8 `text` with its baseline at `place`.
  void text(PixelPosition place, std::string_view text, const TextStyle& style);

  /// Width of `text` in pixels.
  static double width_of(std::string_view text, const TextStyle& style);

  /// Puts `picture` with its upper left corner at (column, row).
  void paste(const Image8& picture, int column, int row);

  const Image8& image() const { return image_; }

 private:
  class Mask;
  void blend(const Mask& mask, Rgb8 colour, double opacity);

  Image8 image_;
};

/// `text` broken at blanks into lines no wider than `width` pixels.
std::vector<std::string_view> wrapped(std::string_view text, double width, const TextStyle& style);

}  // namespace tenku
