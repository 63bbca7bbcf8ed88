/// What is nearest at each place of a window: exact, by cutting polygons.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "beams/window_polygon.h"

namespace tenku {

/// A face in a window.
struct SeenFace {
  std::uint32_t face = 0;
  bool is_mirror = false;
  Nearness nearness;
  WindowPolygon outline;  ///< within the window
  bool is_pane = false;   ///< of two in one place a pane comes before a mirror
};

/// Instead of a face: nothing is there, or it was not asked which face it is.
inline constexpr std::uint32_t kNoFace = std::numeric_limits<std::uint32_t>::max();
inline constexpr std::uint32_t kUndivided = kNoFace - 1;

/// A convex part of a window in which one and the same face is nearest.
struct WindowPart {
  std::vector<WindowPoint> corners;  ///< counter-clockwise
  std::uint32_t face = kNoFace;      ///< or `kUndivided`
};

struct DivisionOptions {
  bool divide_others = true;  ///< false: parts that end at no mirror are told as `kUndivided`, but
                              ///< where nothing at all is seen
  double slack = 1e-7;        ///< width in the units of the window; see `WindowPolygon::cut`
  std::size_t most_parts = std::numeric_limits<std::size_t>::max();
  std::uint64_t most_work = std::numeric_limits<std::uint64_t>::max();  ///< see `Division`
};

/// A window divided, and what it took.
struct Division {
  std::vector<WindowPart> parts;
  std::uint64_t work = 0;  ///< faces that were held against a line
};

/// Divides a window into convex parts without overlap or gap.
///
/// The window is cut in two by the line of an edge that crosses it, again and again, until no edge
/// crosses: then one face covers it, or none does. Where faces cross one another they are cut along
/// the line in which they are equally near. Of two in one place a pane is taken, or else a mirror,
/// or else the one of the lower number.
///
/// @return  one part or one unit of work more than is allowed, where that is not enough
/// Error    the borders lie within `slack` of where they should.
/// Cost     n log n for n faces side by side.
Division divide_window(const WindowPolygon& window, std::vector<SeenFace> faces,
                       const DivisionOptions& options);

}  // namespace tenku
