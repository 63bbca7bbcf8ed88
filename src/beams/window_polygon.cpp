#include "beams/window_polygon.h"

#include <algorithm>
#include <cmath>

namespace tenku {
namespace {

/// Nearer to the apex than this share of the polygon's farthest corner, a point is not projected.
constexpr double kLeastDepth = 1e-9;

/// Corners on the positive side of `height`, those where it changes sign between them.
template <class Point, class Height, class Blend>
std::vector<Point> positive_part(const std::vector<Point>& corners, const Height& height,
                                 const Blend& blend) {
  std::vector<Point> kept;
  kept.reserve(corners.size() + 1);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point &a = corners[k], &b = corners[k + 1 < corners.size() ? k + 1 : 0];
    const double at_a = height(a), at_b = height(b);
    if (at_a >= 0.0) kept.push_back(a);
    if ((at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0)) {
      kept.push_back(blend(a, b, at_a / (at_a - at_b)));
    }
  }
  return kept.size() < 3 ? std::vector<Point>{} : kept;
}

Homogeneous blended(const Homogeneous& a, const Homogeneous& b, double t) {
  return {a.u + t * (b.u - a.u), a.v + t * (b.v - a.v), a.w + t * (b.w - a.w)};
}

std::vector<Homogeneous> seen_before(const BeamView& view, std::span<const Vec3> corners,
                                     const Plane* near) {
  std::vector<Vec3> before(corners.begin(), corners.end());
  if (near != nullptr) {
    before = positive_part(
        before, [&](Vec3 p) { return near->height(p); },
        [](Vec3 a, Vec3 b, double t) { return a + t * (b - a); });
  }
  std::vector<Homogeneous> seen;
  double deepest = 0.0;
  for (const Vec3 p : before) {
    seen.push_back(view.seen(p));
    deepest = std::max(deepest, seen.back().w);
  }
  const double least = kLeastDepth * deepest;
  if (!(deepest > 0.0)) return {};
  return positive_part(
      seen, [&](const Homogeneous& p) { return p.w - least; }, blended);
}

/// Twice the area of the polygon that homogeneous corners make, positive if counter-clockwise.
double signed_area(const std::vector<WindowPolygon::Corner>& corners) {
  double sum = 0.0;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const WindowPoint o = corners[0].at, p = corners[k].at, q = corners[k + 1].at;
    sum += (p.u - o.u) * (q.v - o.v) - (p.v - o.v) * (q.u - o.u);
  }
  return sum;
}

WindowPoint projected(const Homogeneous& p) { return {p.u / p.w, p.v / p.w}; }

/// The outline with its edges, counter-clockwise; edges without length are left out.
WindowPolygon outline_of(std::vector<Homogeneous> seen) {
  std::vector<WindowPolygon::Corner> corners;
  for (const Homogeneous& p : seen) corners.push_back({projected(p), {}, true});
  if (signed_area(corners) < 0.0) std::reverse(seen.begin(), seen.end());
  corners.clear();
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const WindowLine line = line_through(seen[k], seen[k + 1 < seen.size() ? k + 1 : 0]);
    if (line.a == 0.0 && line.b == 0.0) continue;
    corners.push_back({projected(seen[k]), line, true});
  }
  return corners.size() < 3 ? WindowPolygon{} : WindowPolygon(std::move(corners));
}

}  // namespace

WindowLine line_through(const Homogeneous& from, const Homogeneous& to) {
  const double a = from.v * to.w - from.w * to.v, b = from.w * to.u - from.u * to.w,
               c = from.u * to.v - from.v * to.u;
  const double size = std::hypot(a, b);
  // Positive w on both sides: the left of the way is where the height is positive.
  return size > 0.0 ? WindowLine{a / size, b / size, c / size} : WindowLine{};
}

bool WindowPolygon::has_own_edge() const {
  return std::any_of(corners_.begin(), corners_.end(), [](const Corner& c) { return c.is_own; });
}

double WindowPolygon::area() const { return 0.5 * signed_area(corners_); }

std::vector<WindowPoint> WindowPolygon::points() const {
  std::vector<WindowPoint> points;
  points.reserve(corners_.size());
  for (const Corner& c : corners_) points.push_back(c.at);
  return points;
}

WindowPolygon WindowPolygon::cut(const WindowLine& line, double slack, bool is_own) const {
  const std::size_t n = corners_.size();
  std::vector<double> height(n);
  bool any_before = false, any_behind = false;
  for (std::size_t k = 0; k < n; ++k) {
    const double h = line.height(corners_[k].at);
    height[k] = std::abs(h) <= slack ? 0.0 : h;
    any_before = any_before || height[k] > 0.0;
    any_behind = any_behind || height[k] < 0.0;
  }
  if (!any_before) return {};
  std::vector<Corner> kept;
  kept.reserve(n + 1);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = k + 1 < n ? k + 1 : 0;
    const Corner &a = corners_[k], &b = corners_[next];
    const bool along = height[k] == 0.0 && height[next] == 0.0;
    if (height[k] >= 0.0) {
      kept.push_back(a);
      if (along && !is_own) kept.back().is_own = false;
      if (height[k] == 0.0 && height[next] < 0.0) {
        kept.back().edge = line;
        kept.back().is_own = is_own;
      }
    }
    if (height[k] * height[next] < 0.0) {
      const double t = height[k] / (height[k] - height[next]);
      const WindowPoint p{a.at.u + t * (b.at.u - a.at.u), a.at.v + t * (b.at.v - a.at.v)};
      const bool leaves = height[k] > 0.0;
      kept.push_back({p, leaves ? line : a.edge, leaves ? is_own : a.is_own});
    }
  }
  return kept.size() < 3 ? WindowPolygon{} : WindowPolygon(std::move(kept));
}

WindowPolygon window_of(std::span<const WindowPoint> corners) {
  std::vector<Homogeneous> places;
  for (const WindowPoint p : corners) places.push_back({p.u, p.v, 1.0});
  return outline_of(std::move(places));
}

WindowPolygon seen_in_window(const BeamView& view, std::span<const Vec3> corners, const Plane* near,
                             const WindowPolygon& window, double slack) {
  const std::vector<Homogeneous> seen = seen_before(view, corners, near);
  if (seen.empty()) return {};
  // First far from the apex only, so that no coordinate grows beyond use.
  std::vector<Homogeneous> within = seen;
  for (const WindowPolygon::Corner& c : window.corners()) {
    const WindowLine edge{c.edge.a, c.edge.b, c.edge.c + 1.0};
    within = positive_part(
        within, [&](const Homogeneous& p) { return edge.a * p.u + edge.b * p.v + edge.c * p.w; },
        blended);
    if (within.empty()) return {};
  }
  WindowPolygon polygon = outline_of(std::move(within));
  for (const WindowPolygon::Corner& c : window.corners()) {
    if (polygon.empty()) return {};
    polygon = polygon.cut(c.edge, slack, false);
  }
  return polygon;
}

}  // namespace tenku
