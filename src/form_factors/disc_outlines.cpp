#include "form_factors/disc_outlines.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tenku {
namespace {

/// An angle, below a half turn, over its sine. Small angles by the series of the arcsine, which
/// leaves out 3e-9 at most; its terms in pairs, which do not wait for one another.
double angle_over_sine(double square_of_sine, double cosine) {
  const double s = square_of_sine;
  constexpr double kSmall = 0.15;
  if (s < kSmall && cosine > 0.0) {
    const double s2 = s * s;
    return (1.0 + 1.0 / 6.0 * s) + s2 * (3.0 / 40.0 + 5.0 / 112.0 * s) +
           s2 * s2 *
               ((35.0 / 1152.0 + 63.0 / 2816.0 * s) + s2 * (231.0 / 13312.0 + 143.0 / 10240.0 * s));
  }
  const double sine = std::sqrt(s);
  return sine > 0.0 ? std::atan2(sine, cosine) / sine : 0.0;
}

}  // namespace

DiscOutlines::DiscOutlines(const ElementMesh& mesh, const PointView& view, double polyline_deg)
    : mesh_(mesh),
      view_(view),
      by_polylines_(polyline_deg > 0.0),
      cos_polyline_(std::cos(Angle::degrees(polyline_deg).in_radians())),
      sin_polyline_(std::sin(Angle::degrees(polyline_deg).in_radians())) {
  direction_.reserve(view.vertex.size());
  for (const Vec3& v : view.vertex) direction_.push_back(normalized(v));
}

std::span<const PlanePoint> DiscOutlines::operator()(const SeenSide& seen) {
  point_.clear();
  normal_.clear();
  arc_area_ = 0.0;
  const auto& [i, j, k] = mesh_.elements[seen.side / 2];
  if (std::min({view_.vertex[i].z, view_.vertex[j].z, view_.vertex[k].z}) >= 0.0) {  // most
    add_edge(direction_[i], direction_[j]);
    add_edge(direction_[j], direction_[k]);
    add_edge(direction_[k], direction_[i]);
    return point_;
  }
  const ConvexPolygon polygon = view_.polygon(mesh_, seen);
  for (std::size_t c = 0; c < polygon.size(); ++c) {
    const Vec3 next = polygon[c + 1 < polygon.size() ? c + 1 : 0];
    add_edge(normalized(polygon[c]), normalized(next));
  }
  return point_;
}

void DiscOutlines::add_edge(const Vec3& from, const Vec3& to) {
  if (by_polylines_) {
    add_polyline(from, to);
  } else {
    add_arc(from, to);
  }
}

double DiscOutlines::area() const {
  if (!by_polylines_) return std::abs(arc_area_);
  double doubled = 0.0;
  for (std::size_t k = 0; k < point_.size(); ++k) {
    const PlanePoint a = point_[k], b = point_[k + 1 < point_.size() ? k + 1 : 0];
    doubled += a.x * b.y - b.x * a.y;
  }
  return 0.5 * std::abs(doubled);
}

/// The beginning of the arc and the place where y turns, if it does, but not the end. Along the arc
/// y changes by the y of cross(normal, d) at d. What lies between it and the centre is a part of an
/// ellipse, the projection of a sector of a circle of radius 1.
void DiscOutlines::add_arc(const Vec3& from, const Vec3& to) {
  const Vec3 normal = cross(from, to);
  point_.push_back({from.x, from.y});
  normal_.push_back(normal);
  arc_area_ += 0.5 * normal.z * angle_over_sine(dot(normal, normal), dot(from, to));
  const double at_from = normal.z * from.x - normal.x * from.z;
  const double at_to = normal.z * to.x - normal.x * to.z;
  if (!(at_from * at_to < 0.0)) return;
  const Vec3 top = normalized(
      {-normal.x * normal.y, normal.x * normal.x + normal.z * normal.z, -normal.z * normal.y});
  const double sign = at_from > 0.0 ? 1.0 : -1.0;
  point_.push_back({sign * top.x, sign * top.y});
  normal_.push_back(normal);
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

DiscOutlines::Range DiscOutlines::height() const {
  Range height{1.0, -1.0};
  for (const PlanePoint& p : point_) {
    height.low = std::min(height.low, p.y), height.high = std::max(height.high, p.y);
  }
  return height;
}

DiscOutlines::Range DiscOutlines::range() {
  constexpr double kMuch = 1.0;  // half of the height of the disc
  Range range{1.0, -1.0};
  for (const SeenSide& seen : view_.seen) {
    (*this)(seen);
    const auto [low, high] = height();
    range.low = std::min(range.low, low), range.high = std::max(range.high, high);
    if (range.high - range.low > kMuch) return {-1.0, 1.0};
  }
  return range;
}

}  // namespace tenku
