#include "form_factors/disc_outlines.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tenku {

DiscOutlines::DiscOutlines(const ElementMesh& mesh, const PointView& view, double polyline_deg)
    : mesh_(mesh),
      view_(view),
      by_polylines_(polyline_deg > 0.0),
      cos_polyline_(std::cos(Angle::degrees(polyline_deg).in_radians())),
      sin_polyline_(std::sin(Angle::degrees(polyline_deg).in_radians())) {}

std::span<const PlanePoint> DiscOutlines::operator()(const SeenSide& seen) {
  point_.clear();
  normal_.clear();
  const auto& [i, j, k] = mesh_.elements[seen.side / 2];
  const std::array<Vec3, 3> corner{view_.vertex[i], view_.vertex[j], view_.vertex[k]};
  if (std::min({corner[0].z, corner[1].z, corner[2].z}) >= 0.0) {  // most are not cut
    add_outline(corner);
  } else {
    const ConvexPolygon polygon = view_.polygon(mesh_, seen);
    add_outline({polygon.begin(), polygon.size()});
  }
  return point_;
}

void DiscOutlines::add_outline(std::span<const Vec3> corner) {
  if (corner.empty()) return;
  const Vec3 start = normalized(corner[0]);
  Vec3 from = start;
  for (std::size_t k = 0; k < corner.size(); ++k) {
    const Vec3 to = k + 1 < corner.size() ? normalized(corner[k + 1]) : start;
    if (by_polylines_) {
      add_polyline(from, to);
    } else {
      add_arc(from, to, cross(from, to));
    }
    from = to;
  }
}

/// The beginning of the arc and the place where y turns, if it does, but not the end. Along the arc
/// y changes by the y of cross(normal, d) at d.
void DiscOutlines::add_arc(Vec3 from, Vec3 to, Vec3 normal) {
  point_.push_back({from.x, from.y});
  normal_.push_back(normal);
  const double at_from = normal.z * from.x - normal.x * from.z;
  const double at_to = normal.z * to.x - normal.x * to.z;
  if (!(at_from * at_to < 0.0)) return;
  const Vec3 top = normalized(
      {-normal.x * normal.y, normal.x * normal.x + normal.z * normal.z, -normal.z * normal.y});
  const double sign = at_from > 0.0 ? 1.0 : -1.0;
  point_.push_back({sign * top.x, sign * top.y});
  normal_.push_back(normal);
}

/// On the line x^2 + z^2 is 1 - y^2, and on the arc n.x x + n.z z is -n.y y: of the two places that
/// do, the one where y changes as it does on this piece.
double DiscOutlines::crossing(std::size_t point, double y, double x) const {
  if (by_polylines_) return x;
  const Vec3 n = normal_[point];
  const double square = n.x * n.x + n.z * n.z, rest = -n.y * y;
  const double root = std::sqrt(std::max(0.0, square * (1.0 - y * y) - rest * rest));
  const std::size_t next = point + 1 < point_.size() ? point + 1 : 0;
  return (n.x * rest + (point_[next].y > point_[point].y ? n.z : -n.z) * root) / square;
}

/// The beginning of the arc and what is between, not its end. Each point is the reflection of the
/// last but one in the last.
void DiscOutlines::add_polyline(Vec3 from, Vec3 to) {
  const double cosine = dot(from, to);
  point_.push_back({from.x, from.y});
  if (cosine >= cos_polyline_) return;
  const Vec3 along = normalized(to - cosine * from);
  Vec3 last = from, at = cos_polyline_ * from + sin_polyline_ * along;
  while (dot(at, to) < cos_polyline_) {
    point_.push_back({at.x, at.y});
    const Vec3 next = 2.0 * cos_polyline_ * at - last;
    last = at, at = next;
  }
  point_.push_back({at.x, at.y});
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
