#include "radiosity/disc_outlines.h"

#include <algorithm>
#include <cmath>

namespace tenku {

DiscOutlines::DiscOutlines(const ElementMesh& mesh, const PointView& view, double polyline_deg)
    : cos_polyline_(std::cos(Angle::degrees(polyline_deg).in_radians())),
      polyline_rad_(Angle::degrees(polyline_deg).in_radians()) {
  point_.reserve(4 * view.seen.size());
  begin_.reserve(view.seen.size() + 1);
  for (const SeenSide& seen : view.seen) {
    const ConvexPolygon polygon = view.polygon(mesh, seen);
    Vec3 from = polygon.empty() ? Vec3{} : normalized(polygon[polygon.size() - 1]);
    for (const Vec3& corner : polygon) {
      const Vec3 to = normalized(corner);
      add_arc(from, to);
      from = to;
    }
    begin_.push_back(point_.size());
  }
  if (point_.empty()) return;
  const auto below = [](const PlanePoint& a, const PlanePoint& b) { return a.y < b.y; };
  const auto [low, high] = std::minmax_element(point_.begin(), point_.end(), below);
  low_ = low->y, high_ = high->y;
}

/// The end of the arc and what is between, not its beginning.
void DiscOutlines::add_arc(Vec3 from, Vec3 to) {
  if (dot(from, to) < cos_polyline_) {
    const double angle = angle_between(from, to).in_radians();
    const int pieces = static_cast<int>(std::ceil(angle / polyline_rad_));
    for (int k = 1; k < pieces; ++k) {
      const double at = angle * k / pieces;
      const Vec3 d = normalized(std::sin(angle - at) * from + std::sin(at) * to);
      point_.push_back({d.x, d.y});
    }
  }
  point_.push_back({to.x, to.y});
}

}  // namespace tenku
