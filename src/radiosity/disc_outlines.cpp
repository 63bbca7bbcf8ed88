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
  arc_.clear();
  normal_ = {};
  ConvexPolygon direction;
  for (const Vec3& corner : view_.polygon(mesh_, seen)) direction.add(normalized(corner));
  if (direction.empty()) return {};
  set_polyline(direction);
  for (std::size_t k = 0; k < direction.size(); ++k) {
    const Vec3 from = direction[k], to = direction[k + 1 < direction.size() ? k + 1 : 0];
    normal_.add(cross(from, to));
    add_arc(from, to);
    arc_.resize(point_.size(), static_cast<std::uint8_t>(k));
  }
  return point_;
}

/// A segment over the angle t cuts t^2 / 8 off at most: a part of the width, which is the area over
/// the longest edge.
void DiscOutlines::set_polyline(const ConvexPolygon& direction) {
  constexpr double kPart = 0.03, kMostPieces = 64.0;  // of the width; of an edge
  double doubled_area = 0.0, longest2 = 0.0;
  for (std::size_t k = 0; k < direction.size(); ++k) {
    const Vec3 a = direction[k], b = direction[k + 1 < direction.size() ? k + 1 : 0];
    doubled_area += a.x * b.y - a.y * b.x;
    longest2 = std::max(longest2, (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
  }
  const double cut2 = 4.0 * kPart * std::abs(doubled_area);  // times the longest edge
  if (cut2 * cut2 >= longest2 * std::pow(polyline_rad_, 4.0) && used_rad_ == polyline_rad_) return;
  const double narrow = longest2 > 0.0 ? std::sqrt(cut2 / std::sqrt(longest2)) : polyline_rad_;
  used_rad_ = std::min(polyline_rad_, std::max(narrow, std::sqrt(longest2) / kMostPieces));
  cos_polyline_ = std::cos(used_rad_), sin_polyline_ = std::sin(used_rad_);
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
