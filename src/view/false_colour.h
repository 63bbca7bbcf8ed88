/// Values as colours.
#pragma once

#include <span>

#include "view/image.h"
#include "view/value_scale.h"

namespace tenku {

/// Maps whose lightness rises evenly, so that a printed or colour-blind view keeps the order.
///
/// Source   viridis and inferno by S. van der Walt and N. Smith (matplotlib, 2015, CC0), as
///          polynomials of degree 6 fitted by M. Zucker (Shadertoy WlfXRN, CC0).
/// Error    within 0.04 of the original tables in each channel (tested at ten places).
enum class ColourMap { Viridis, Inferno, Grey };

/// Colour at `position` in 0..1; positions outside are clipped.
Rgb8 colour_at(ColourMap map, double position);

/// Colour of what has no value: a light grey that no map contains.
inline constexpr Rgb8 kNoValueColour{226, 226, 222};

/// Picture of `values`, [row][column], row 0 at the top; NaN gets `kNoValueColour`.
///
/// @param values  width * height of them
Image8 false_colour(std::span<const double> values, int width, const ValueScale& scale,
                    ColourMap map = ColourMap::Viridis);

/// Picture of the luminance of `image`.
Image8 false_colour(const Image& image, const ValueScale& scale,
                    ColourMap map = ColourMap::Viridis);

}  // namespace tenku
