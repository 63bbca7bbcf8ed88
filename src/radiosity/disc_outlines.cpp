#include "radiosity/disc_outlines.h"

#include <algorithm>
#include <cmath>

namespace tenku {

DiscOutlines::DiscOutlines(const ElementMesh& mesh, const PointView& view, double polyline_deg)
    : mesh_(mesh),
      view_(view),
      cos_polyline_(std::cos(Angle::degrees(polyline_deg).in_radians())),
      sin_polyline_(std::sin(Angle::degrees(polyline_deg).in_radians())) {}

std::span<const PlanePoint> DiscOutlines::operator()(const SeenSide& seen) {
  point_.clear();
  const ConvexPolygon polygon = view_.polygon(mesh_, seen);
  if (polygon.empty()) return {};
  const Vec3 start = normalized(polygon[0]);
  Vec3 from = start;
  for (std::size_t k = 1; k < polygon.size(); ++k) {
    const Vec3 to = normalized(polygon[k]);
    add_arc(from, to);
    from = to;
  }
  add_arc(from, start);
  return point_;
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
