/// What a map needs beside the map: colour bar, scale bar, north arrow.
#pragma once

#include <string_view>

#include "output/canvas.h"
#include "view/false_colour.h"

namespace tenku {

/// Legend of a false-colour picture.
struct ColourBar {
  ValueScale scale;
  ColourMap map = ColourMap::Viridis;
  std::string_view quantity;  ///< such as `Illuminance on the ground`
  std::string_view unit;      ///< such as `lx`
};

/// Draws a horizontal bar whose upper left corner is `place`, `length` pixels long, its quantity
/// and unit above it and its ticks below: 64 pixels high in all at `text_size` 14.
void draw_colour_bar(Canvas& canvas, PixelPosition place, double length, const ColourBar& bar,
                     double text_size = 14.0);

/// Draws a bar of a round length (1, 2 or 5 times a power of ten metres), at most `longest` pixels
/// long, from `place` (its left end) to the right, with its length above.
/// @return the length drawn, in metres
double draw_scale_bar(Canvas& canvas, PixelPosition place, double longest, double metres_per_pixel,
                      double text_size = 14.0);

/// Draws an arrow to the top of the sheet with an N, `height` pixels high, standing on `foot`.
void draw_north_arrow(Canvas& canvas, PixelPosition foot, double height = 46.0);

}  // namespace tenku
