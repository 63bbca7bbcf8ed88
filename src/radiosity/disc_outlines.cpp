#include "radiosity/disc_outlines.h"

#include <algorithm>
#include <cmath>

namespace tenku {

DiscOutlines::DiscOutlines(const ElementMesh& mesh, const PointView& view, double polyline_deg)
    : mesh_(mesh),
      view_(view),
      polyline_rad_(Angle::degrees(polyline_deg).in_radians()),
      used_rad_(polyline_rad_),
      cos_polyline_(std::cos(polyline_rad_)),
      sin_polyline_(std::sin(polyline_rad_)) {}

std::span<const PlanePoint> DiscOutlines::operator()(const SeenSide& seen) {
  point_.clear();
  ConvexPolygon directions;
  for (const Vec3& corner : view_.polygon(mesh_, seen)) directions.add(normalized(corner));
  if (directions.empty()) return {};
  set_polyline(directions);
  for (std::size_t k = 1; k < directions.size(); ++k) add_arc(directions[k - 1], directions[k]);
  add_arc(directions[directions.size() - 1], directions[0]);
  return point_;
}

/// A segment over the angle t cuts t^2 / 8 off at most: a part of the width, which is the area over
/// the longest edge.
void DiscOutlines::set_polyline(const ConvexPolygon& polygon) {
  constexpr double kPart = 0.005, kLeast = 0.01;  // of the width; of the angle asked for
  double doubled_area = 0.0, longest2 = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 a = polygon[k], b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    doubled_area += a.x * b.y - a.y * b.x;
    longest2 = std::max(longest2, (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
  }
  const double width = 0.5 * std::abs(doubled_area) / std::sqrt(longest2);
  const double narrow = std::max(std::sqrt(8.0 * kPart * width), kLeast * polyline_rad_);
  const double rad = std::min(polyline_rad_, longest2 > 0.0 ? narrow : polyline_rad_);
  if (rad == used_rad_) return;
  used_rad_ = rad, cos_polyline_ = std::cos(rad), sin_polyline_ = std::sin(rad);
}

/// The end of the arc and what is between, not its beginning. Each point is the reflection of the
/// last but one in the last.
void DiscOutlines::add_arc(Vec3 from, Vec3 to) {
  const double cosine = dot(from, to);
  if (cosine < cos_polyline_) {
    const Vec3 along = normalized(to - cosine * from);
    Vec3 last = from, at = cos_polyline_ * from + sin_polyline_ * along;
    while (dot(at, to) < cos_polyline_) {
      point_.push_back({at.x, at.y});
      const Vec3 next = 2.0 * cos_polyline_ * at - last;
      last = at, at = next;
    }
    point_.push_back({at.x, at.y});
  }
  point_.push_back({to.x, to.y});
}

DiscOutlines::Range DiscOutlines::range() {
  constexpr double kMuch = 1.0;  // half of the height of the disc
  Range range{1.0, -1.0};
  for (const SeenSide& seen : view_.seen) {
    for (const PlanePoint& p : (*this)(seen)) {
      range.low = std::min(range.low, p.y), range.high = std::max(range.high, p.y);
    }
    if (range.high - range.low > kMuch) return {-1.0, 1.0};
  }
  return range;
}

}  // namespace tenku
