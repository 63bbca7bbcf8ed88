#include "radiosity/visible_spans.h"

#include <algorithm>
#include <cmath>

namespace tenku {

void VisibleSpans::add_line(double y, std::span<DiscSpan> spans) {
  std::sort(spans.begin(), spans.end(), [](const DiscSpan& a, const DiscSpan& b) {
    return a.x0 < b.x0 || (a.x0 == b.x0 && a.seen < b.seen);
  });
  y_ = y;
  open_.clear();
  for (const DiscSpan& span : spans) {
    advance(span.x0);
    open(span);
  }
  advance(2.0);  // beyond the disc
}

Vec3 VisibleSpans::direction(double x) const {
  return {x, y_, std::sqrt(std::max(0.0, 1.0 - x * x - y_ * y_))};
}

/// Planes that cross both between two ends where one is nearer are left aside: elements that cross
/// each other twice on a line do not occur among flat ones but where both crossings are far off.
void VisibleSpans::open(const DiscSpan& span) {
  const Vec3 nearness = view_.seen[span.seen].nearness;
  const Vec3 begin = direction(span.x0), end = direction(span.x1);
  for (const Open& other : open_) {
    if (other.x1 >= span.x1 && dot(other.nearness - nearness, begin) > 0.0 &&
        dot(other.nearness - nearness, end) > 0.0) {
      return;
    }
  }
  std::erase_if(open_, [&](const Open& other) {
    return other.x1 <= span.x1 && dot(nearness - other.nearness, begin) > 0.0 &&
           dot(nearness - other.nearness, other.end) > 0.0;
  });
  open_.push_back({span.x1, nearness, end, span.seen});
}

void VisibleSpans::advance(double x) {
  while (!open_.empty() && x_ < x) {
    double to = x;
    for (const Open& span : open_) to = std::min(to, span.x1);
    if (to > x_) resolve(x_, to, 0);
    x_ = std::max(x_, to);
    std::erase_if(open_, [&](const Open& span) { return span.x1 <= x_; });
  }
  x_ = x;
}

void VisibleSpans::resolve(double from, double to, int depth) {
  if (open_.size() == 1) {
    length_[open_.front().seen] += to - from;
    return;
  }
  const Vec3 begin = direction(from), end = direction(to);
  const Open &first = nearest(begin, end), &last = nearest(end, begin);
  constexpr int kDepth = 16;
  if (&first == &last || depth == kDepth || dot(last.nearness - first.nearness, end) <= 0.0) {
    length_[first.seen] += to - from;
    return;
  }
  const double at = order_changes(last.nearness - first.nearness, from, to);
  if (!(at > from && at < to)) {
    length_[(2.0 * at < from + to ? last : first).seen] += to - from;
    return;
  }
  resolve(from, at, depth + 1);
  resolve(at, to, depth + 1);
}

/// Nearest in a direction; of equals, the one that is nearest in the direction `then`.
const VisibleSpans::Open& VisibleSpans::nearest(Vec3 direction, Vec3 then) const {
  const Open* best = &open_.front();
  for (const Open& span : open_) {
    const double by = dot(span.nearness - best->nearness, direction);
    if (by > 0.0 || (by == 0.0 && dot(span.nearness - best->nearness, then) > 0.0)) best = &span;
  }
  return *best;
}

/// Where dot(difference, direction(x)) is 0, between a place where it is negative and one where it
/// is positive. On the line x = r cos t and z = r sin t, so that a cos(t - t0) = -b.
double VisibleSpans::order_changes(Vec3 difference, double from, double to) const {
  const double r = std::sqrt(std::max(0.0, 1.0 - y_ * y_));
  const double a = r * std::hypot(difference.x, difference.z), b = y_ * difference.y;
  if (!(a > std::abs(b))) return from;
  const double middle = std::atan2(difference.z, difference.x), half = std::acos(-b / a);
  const double one = r * std::cos(middle + half), other = r * std::cos(middle - half);
  const double centre = 0.5 * (from + to);
  return std::abs(one - centre) < std::abs(other - centre) ? one : other;
}

}  // namespace tenku
