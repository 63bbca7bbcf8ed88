/// Elements projected onto the disc under a hemisphere.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
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

  /// Area inside the last outline.
  double area() const;

  /// Range of y.
  struct Range {
    double low, high;
  };
  /// Of the last outline; low is above high where it is empty.
  Range height() const;

  /// Cuts the outline of a seen side: `ScanLines::spans`.
  template <class Emit>
  void spans(const SeenSide& seen, ScanLines& scan, const Emit& emit) {
    const auto outline = (*this)(seen);
    if (by_polylines_) {
      scan.spans(outline, emit);
    } else {
      scan.spans(outline, emit, [this](std::size_t k, PlanePoint a, PlanePoint b) {
        return Arc(normal_[k], b.y > a.y);
      });
    }
  }

  /// Range in which all outlines lie: the whole disc where they fill much of it.
  Range range();

 private:
  /// Where an arc on which y only rises, or only falls, crosses a line. On the line x^2 + z^2 is
  /// 1 - y^2, and on the arc n.x x + n.z z is -n.y y: one of the two places that do.
  class Arc {
   public:
    Arc(Vec3 n, bool rises) {
      square_ = n.x * n.x + n.z * n.z;
      all_ = square_ + n.y * n.y;
      of_y_ = -n.x * n.y / square_;
      of_root_ = (rises ? n.z : -n.z) / square_;
    }
    double operator()(double y) const {
      return of_y_ * y + of_root_ * std::sqrt(std::max(0.0, square_ - all_ * y * y));
    }

   private:
    double square_, all_, of_y_, of_root_;
  };

  void add_edge(const Vec3& from, const Vec3& to);
  void add_polyline(Vec3 from, Vec3 to);
  void add_arc(const Vec3& from, const Vec3& to);

  const ElementMesh& mesh_;
  const PointView& view_;
  bool by_polylines_;
  double cos_polyline_, sin_polyline_;
  std::vector<Vec3> direction_;  ///< of each vertex of the mesh
  std::vector<PlanePoint> point_;
  std::vector<Vec3> normal_;  ///< [point]: of the plane through the origin and the arc to the next
  double arc_area_ = 0.0;     ///< between the arcs and the centre, those that run back negative
};

}  // namespace tenku
