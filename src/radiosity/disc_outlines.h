/// Elements projected onto the disc under a hemisphere.
#pragma once

#include <cstdint>
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
/// `polyline_deg` at most, as seen from the point. Segments tell which lines cross an edge; where
/// they do is then put right in closed form (`crossing`), for an outline seen nearly edge-on is
/// narrower than what a segment cuts off.
///
/// Source  A. Doi and T. Itoh, "Acceleration techniques for the progressive refinement radiosity
///         method", IPSJ 47th convention, 2V-6, 1993: eqs. 1, 2 and 4. The depth of a corner is not
///         kept: `SeenSide::nearness` tells it exactly, wherever it is asked for.
/// Threads  one a thread.
class DiscOutlines {
 public:
  /// @param mesh, view  kept by reference
  DiscOutlines(const ElementMesh& mesh, const PointView& view, double polyline_deg);

  /// Outline of a seen side, valid until the next call. May be empty.
  std::span<const PlanePoint> operator()(const SeenSide& seen);

  /// Where the arc behind a segment of the last outline crosses the line at `y`.
  /// @param segment  number of the point that it begins with
  /// @param x        where the segment itself does
  double crossing(std::size_t segment, double y, double x) const;
  /// `crossing`, as `ScanLines` takes it.
  auto exactly() const {
    return [this](std::size_t k, double y, double x) { return crossing(k, y, x); };
  }

  /// Range of y in which all outlines lie: the whole disc where they fill much of it.
  struct Range {
    double low, high;
  };
  Range range();

 private:
  void set_polyline(const ConvexPolygon& direction);
  void add_arc(Vec3 from, Vec3 to);

  const ElementMesh& mesh_;
  const PointView& view_;
  double polyline_rad_, used_rad_;      ///< asked for, and of the outline at hand
  double cos_polyline_, sin_polyline_;  ///< of `used_rad_`
  std::vector<PlanePoint> point_;
  std::vector<std::uint8_t> arc_;  ///< [point]: number of the edge that the next segment is on
  ConvexPolygon normal_;           ///< of the planes through the edges and the origin
};

}  // namespace tenku
