/// How much of an area has how much light, as a chart.
#pragma once

#include <span>
#include <string>

#include "view/value_scale.h"

namespace tenku {

/// What the chart shows: each value stands for an area (or any other weight).
struct Histogram {
  std::string title;     ///< for screen readers
  std::string quantity;  ///< axis: `Illuminance`
  std::string unit;      ///< `lx`
  std::span<const double> values;
  std::span<const double> weights;  ///< empty: all alike
  bool logarithmic = false;
  int bars = 30;  ///< about
};

/// The chart as an SVG picture; the height of a bar is its share of the whole, in percent. Values
/// beyond the scale are counted in its last bar; values that are not finite are left out.
std::string histogram_svg(const Histogram& histogram);

}  // namespace tenku
