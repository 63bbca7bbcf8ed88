/// The false-colour plan of the ground, as a client reads it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/vec3.h"
#include "view/camera.h"
#include "view/false_colour.h"

namespace tenku {

/// Triangle of the ground with a value at each corner; NaN: no value.
struct PlanTriangle {
  std::array<Vec3, 3> corners;
  std::array<double, 3> values;
};

/// Triangle of a building (any of its faces; those seen from above are drawn).
struct PlanFace {
  std::array<Vec3, 3> corners;
  std::uint32_t object = 0;  ///< outlines are drawn where this changes
};

/// Values at the centres of square cells.
///
/// Shape    [row][column]; row 0 is the northernmost. NaN: no value.
struct PlanGrid {
  double west = 0.0, north = 0.0;  ///< of the corner of the first cell, metres
  double cell_m = 1.0;
  int columns = 0, rows = 0;
  std::vector<double> values;
};

/// Rectangle of the ground, metres.
struct PlanExtent {
  double west = 0.0, south = 0.0, east = 0.0, north = 0.0;
};

/// What the plan shows. Values come from `ground`, from `grid`, or both (the ground wins).
struct PlanMap {
  std::string title, caption;
  std::string quantity = "Illuminance on the ground";
  std::string unit = "lx";
  std::vector<PlanTriangle> ground;
  std::optional<PlanGrid> grid;
  std::vector<PlanFace> buildings;
  std::optional<PlanExtent> extent;  ///< default: all that is given, and a margin
  std::optional<ValueScale> scale;   ///< default: round, from the values
  bool logarithmic = false;
  ColourMap map = ColourMap::Viridis;
  int width = 1400;  ///< pixels of the whole sheet, at least 600
};

/// The sheet: title, map with north up and east to the right, colour bar, scale bar, north arrow,
/// caption.
///
/// Cost     about 20 bytes of memory for each of the four samples of a pixel.
/// @throws InputError if there is nothing to draw, a coordinate is not finite or the width is not
///         in 600..8192
Image8 plan_map(const PlanMap& map);

}  // namespace tenku
