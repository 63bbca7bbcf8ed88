/// Convex polygons in the window of beams, and how lines cut them.
#pragma once

#include <span>
#include <vector>

#include "beams/beam_view.h"

namespace tenku {

/// Places at which `a u + b v + c` is zero; that height is a distance, since a^2 + b^2 = 1.
struct WindowLine {
  double a = 0.0, b = 0.0, c = 0.0;

  double height(WindowPoint p) const { return a * p.u + b * p.v + c; }
  WindowLine reversed() const { return {-a, -b, -c}; }
};

/// Line through two places given by homogeneous coordinates, its positive side to the left of the
/// way from the first to the second; all zero where they are one place.
WindowLine line_through(const Homogeneous& from, const Homogeneous& to);

/// A convex polygon that a window of beams is cut down to, or a face seen in such a window.
///
/// An edge of a face is its own where it crosses the window, and not where it is the window's: a
/// polygon without an edge of its own covers the window.
///
/// Frame    counter-clockwise in (u, v): to the left of every edge.
class WindowPolygon {
 public:
  struct Corner {
    WindowPoint at;
    WindowLine edge;  ///< to the next corner; the polygon is on its positive side
    bool is_own = true;
  };

  WindowPolygon() = default;
  explicit WindowPolygon(std::vector<Corner> corners) : corners_(std::move(corners)) {}

  bool empty() const { return corners_.empty(); }
  std::size_t size() const { return corners_.size(); }
  const std::vector<Corner>& corners() const { return corners_; }
  bool has_own_edge() const;
  double area() const;
  std::vector<WindowPoint> points() const;

  /// The edge runs along the border of the window.
  void disown(std::size_t edge) { corners_[edge].is_own = false; }

  /// The part on the positive side of a line, nothing where it would reach less than `slack` beyond
  /// it. Corners within `slack` of the line count as on it, and edges between two such corners are
  /// no longer own.
  /// @param is_own  of the edge that the line makes
  [[nodiscard]] WindowPolygon cut(const WindowLine& line, double slack, bool is_own) const;

 private:
  std::vector<Corner> corners_;
};

/// Convex polygon of a window: corners in either sense.
WindowPolygon window_of(std::span<const WindowPoint> corners);

/// A convex polygon of space, seen in a window: the part within the window and before `near`.
///
/// @param near  points whose height is negative are not seen; null: all are
/// @param slack width, in the units of the window, below which nothing is seen
/// @return      empty where nothing is seen
WindowPolygon seen_in_window(const BeamView& view, std::span<const Vec3> corners, const Plane* near,
                             const WindowPolygon& window, double slack);

}  // namespace tenku
