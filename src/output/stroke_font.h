/// The lettering of maps and pictures: our own strokes, so that no font file is needed.
#pragma once

#include <string_view>
#include <vector>

#include "view/image.h"

namespace tenku {

/// One glyph's way of the pen, for a letter of em size 1.
///
/// Frame    x right, y down, the origin where the baseline begins.
/// Units    em; capitals are 0.7 em high, small letters 0.5, tails reach 0.21 below the line.
struct PenStroke {
  std::vector<PixelPosition> points;  ///< one point alone is a dot
};

/// The strokes of a line of text, and how far it advances.
struct PenText {
  std::vector<PenStroke> strokes;
  double width = 0.0;  ///< em
};

/// Strokes of `text`: ASCII 32-126, Latin letters with accents, and the signs of this field
/// (degree, plus-minus, times, middle dot, square and cube, micro, dashes, quotes). Any other
/// character becomes an open box. `text` is UTF-8.
PenText pen_text(std::string_view text);

}  // namespace tenku
