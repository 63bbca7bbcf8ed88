/// Elements projected onto the disc under a hemisphere.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "form_factors/point_view.h"
#include "form_factors/scan_lines.h"

namespace tenku {

/// Outlines on the disc of radius 1 under the hemisphere about a point: the area of what is inside,
/// in parts of the disc's, is the form factor (W. Nusselt, 1928).
///
/// A corner at p lies on the disc at the x and y of p / |p|, and an edge is an arc of an ellipse.
/// Arcs are taken as they are: cut where y turns, so that a line crosses a piece once, in a place
/// known in closed form. Or, as in the source, they are replaced by polylines with corners on the
/// arc, each segment of which spans `polyline_deg` at most, as seen from the point.
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

  /// Where the arc from a point of the last outline to the next crosses the line at `y`.
  /// @param x  where a straight edge does
  double crossing(std::size_t point, double y, double x) const;
  /// `crossing`, as `ScanLines` takes it.
  auto exactly() const {
    return [this](std::size_t point, double y, double x) { return crossing(point, y, x); };
  }

  /// Range of y in which all outlines lie: the whole disc where they fill much of it.
  struct Range {
    double low, high;
  };
  Range range();

 private:
  void add_outline(std::span<const Vec3> corner);
  void add_polyline(Vec3 from, Vec3 to);
  void add_arc(Vec3 from, Vec3 to, Vec3 normal);

  const ElementMesh& mesh_;
  const PointView& view_;
  bool by_polylines_;
  double cos_polyline_, sin_polyline_;
  std::vector<PlanePoint> point_;
  std::vector<Vec3> normal_;  ///< [point]: of the plane through the origin and the arc to the next
};

}  // namespace tenku
