/// Elements projected onto the disc under a hemisphere.
#pragma once

#include <span>
#include <vector>

#include "radiosity/point_view.h"
#include "radiosity/scan_lines.h"

namespace tenku {

/// Outlines on the disc of radius 1 under the hemisphere about a point: the area of what is inside,
/// in parts of the disc's, is the form factor (W. Nusselt, 1928).
///
/// A corner at p lies on the disc at the x and y of p / |p|, and an edge is an arc of an ellipse.
/// It is replaced by a polyline with its corners on the arc, each segment of which spans
/// `polyline_deg` at most, as seen from the point.
///
/// Source  A. Doi and T. Itoh, "Acceleration techniques for the progressive refinement radiosity
///         method", IPSJ 47th convention, 2V-6, 1993: eqs. 1, 2 and 4. The depth of a corner is not
///         kept: `SeenSide::nearness` tells it exactly, wherever it is asked for.
/// Error   a polyline takes less than polyline^2 / 6 (in radians) of an area bounded by arcs away:
///         5e-5 of it for one degree. What one outline loses at an edge, its neighbour gains.
/// Threads  one a thread.
class DiscOutlines {
 public:
  /// @param mesh, view  kept by reference
  DiscOutlines(const ElementMesh& mesh, const PointView& view, double polyline_deg);

  /// Outline of a seen side, valid until the next call. May be empty.
  std::span<const PlanePoint> operator()(const SeenSide& seen);

  /// Range of y in which all outlines lie: the whole disc where they fill much of it.
  struct Range {
    double low, high;
  };
  Range range();

 private:
  void add_arc(Vec3 from, Vec3 to);

  const ElementMesh& mesh_;
  const PointView& view_;
  void set_polyline(const ConvexPolygon& polygon);

  double polyline_rad_, used_rad_;      ///< asked for, and of the outline at hand
  double cos_polyline_, sin_polyline_;  ///< of `used_rad_`
  std::vector<PlanePoint> point_;
};

}  // namespace tenku
