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
  arc_.clear();
  normal_ = {};
  const ConvexPolygon polygon = view_.polygon(mesh_, seen);
  if (polygon.empty()) return {};
  const Vec3 start = normalized(polygon[0]);
  Vec3 from = start;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 to = k + 1 < polygon.size() ? normalized(polygon[k + 1]) : start;
    normal_.add(cross(from, to));
    add_arc(from, to);
    arc_.resize(point_.size(), static_cast<std::uint8_t>(k));
    from = to;
  }
  return point_;
}

/// On the line x^2 + z^2 is 1 - y^2, and on the arc n.x x + n.z z is -n.y y.
double DiscOutlines::crossing(std::size_t segment, double y, double x) const {
  const Vec3 n = normal_[arc_[segment]];
  const double square = n.x * n.x + n.z * n.z, rest = -n.y * y;
  const double root2 = square * (1.0 - y * y) - rest * rest;
  if (!(root2 > 0.0)) return x;
  const double middle = n.x * rest / square, off = n.z * std::sqrt(root2) / square;
  const double one = middle + off, other = middle - off;
  return std::abs(one - x) < std::abs(other - x) ? one : other;
}

/// The beginning of the arc and what is between, not its end. Each point is the reflection of the
/// last but one in the last.
void DiscOutlines::add_arc(Vec3 from, Vec3 to) {
  const double cosine = dot(from, to);
  point_.push_back({from.x, from.y});
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
