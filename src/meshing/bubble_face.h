/// One polygon while bubbles are put into it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "meshing/bubble_grid.h"
#include "meshing/flat_polygon.h"

namespace tenku {

/// A straight edge between two bubbles that do not move.
struct BubblePiece {
  std::uint32_t a, b;
  bool is_outline;  ///< with the surface to its left only
};

/// Bubbles of a polygon, in its plane: first those that stay, on its outline and on constraints.
struct BubbleFace {
  std::function<double(PlanePoint)> size_at;
  std::vector<PlanePoint> at;  ///< [bubble]
  std::vector<double> size_m;  ///< [bubble] at its place
  std::size_t fixed = 0;       ///< so many do not move
  std::vector<BubblePiece> pieces;

  std::uint32_t add(PlanePoint p, double size) {
    at.push_back(p);
    size_m.push_back(size);
    return static_cast<std::uint32_t>(at.size() - 1);
  }
};

/// Whether a size can be that of a bubble.
inline bool is_size(double size_m) { return size_m > 0.0 && std::isfinite(size_m); }

/// Distance of `p` from the segment from `a` to `b`.
inline double distance_to_segment(PlanePoint p, PlanePoint a, PlanePoint b) {
  const double dx = b.x - a.x, dy = b.y - a.y, whole = dx * dx + dy * dy;
  const double t =
      whole > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / whole, 0.0, 1.0) : 0.0;
  const double x = p.x - a.x - t * dx, y = p.y - a.y - t * dy;
  return std::sqrt(x * x + y * y);
}

/// Twice the area of a triangle, positive where it is counter-clockwise.
inline double doubled_area(PlanePoint a, PlanePoint b, PlanePoint c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Whether two segments meet, or touch, as far as rounding tells.
inline bool segments_meet(PlanePoint a, PlanePoint b, PlanePoint c, PlanePoint d) {
  const double c_side = doubled_area(a, b, c), d_side = doubled_area(a, b, d);
  const double a_side = doubled_area(c, d, a), b_side = doubled_area(c, d, b);
  return !(c_side * d_side > 0.0) && !(a_side * b_side > 0.0);
}

/// Pieces that can be asked for by where they are.
///
/// Each has marks along it, no farther apart than the size there, so that long ones are found too.
class PieceMarks {
 public:
  explicit PieceMarks(const BubbleFace& face);

  /// Calls `visit(piece)` for pieces that may come nearer to `p` than `reach` times the size there;
  /// for some more than once.
  template <class Visit>
  void for_each_near(PlanePoint p, double size_m, double reach, const Visit& visit) const {
    // Half the way between two marks is added to the reach.
    grid_.for_each_near(p, size_m, reach + 0.6, [&](std::uint32_t mark) { visit(piece_[mark]); });
  }

 private:
  std::vector<std::uint32_t> piece_;  ///< [mark]
  BubbleGrid grid_;
};

}  // namespace tenku
