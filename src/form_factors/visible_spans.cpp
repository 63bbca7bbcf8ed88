#include "form_factors/visible_spans.h"

#include <algorithm>
#include <cmath>

namespace tenku {
namespace {

constexpr double kTouching = 1e-9;  // in parts of the nearness, and of the disc's radius

template <class T>
void sort_from_left(std::span<T> spans) {
  std::sort(spans.begin(), spans.end(), [](const T& a, const T& b) {
    return a.x0 < b.x0 || (a.x0 == b.x0 && a.seen < b.seen);
  });
}

bool is_one_plane(Vec3 a, Vec3 b) {
  const Vec3 difference = a - b;
  return dot(difference, difference) <= kTouching * kTouching * dot(a, a);
}

}  // namespace

std::vector<std::uint32_t> sheets_of(const PointView& view) {
  std::vector<std::uint32_t> sheet(view.seen.size());
  std::size_t first = 0;
  for (std::size_t s = 1; s < sheet.size(); ++s) {
    const bool goes_on = is_one_plane(view.seen[first].nearness, view.seen[s].nearness);
    sheet[s] = sheet[s - 1] + (goes_on ? 0 : 1);
    if (!goes_on) first = s;
  }
  return sheet;
}

void VisibleSpans::add_line(double y, std::span<DiscSpan> spans) {
  y_ = y;
  spans_ = spans;
  strip_.clear();
  for (std::size_t begin = 0, end = 0; begin < spans.size(); begin = end) {
    while (end < spans.size() && sheet_[spans[end].seen] == sheet_[spans[begin].seen]) ++end;
    add_strips(begin, end);
  }
  sort_from_left(std::span(strip_));
  open_.clear();
  for (std::size_t s = 0; s < strip_.size(); ++s) {
    advance(strip_[s].x0);
    open(s);
  }
  advance(2.0);  // beyond the disc
}

/// Spans of a sheet that overlap, as those of walls that coincide do, are strips of their own.
void VisibleSpans::add_strips(std::size_t begin, std::size_t end) {
  sort_from_left(spans_.subspan(begin, end - begin));
  for (std::size_t k = begin; k < end; ++k) {
    const DiscSpan& span = spans_[k];
    if (k > begin && std::abs(span.x0 - strip_.back().x1) <= kTouching) {
      strip_.back().x1 = span.x1;
      strip_.back().end = k + 1;
    } else {
      strip_.push_back({span.x0, span.x1, span.seen, k, k + 1});
    }
  }
}

Vec3 VisibleSpans::direction(double x) const {
  return {x, y_, std::sqrt(std::max(0.0, 1.0 - x * x - y_ * y_))};
}

/// Whether one plane is before another at a middle place, and not behind it at two ends: there
/// elements that share an edge meet, maybe at both, and rounding says nothing.
bool VisibleSpans::hides(Vec3 one, Vec3 other, const std::array<Vec3, 3>& places) {
  const Vec3 difference = one - other;
  const auto not_behind = [&](Vec3 d) { return dot(difference, d) >= -kTouching * dot(one, d); };
  return dot(difference, places[1]) > 0.0 && not_behind(places[0]) && not_behind(places[2]);
}

void VisibleSpans::open(std::size_t number) {
  const Strip& span = strip_[number];
  const Vec3 nearness = view_.seen[span.seen].nearness;
  const Vec3 begin = direction(span.x0), end = direction(span.x1);
  const Vec3 middle = direction(0.5 * (span.x0 + span.x1));
  for (const Open& other : open_) {
    if (other.x1 >= span.x1 && hides(other.nearness, nearness, {begin, middle, end})) return;
  }
  std::erase_if(open_, [&](const Open& other) {
    return other.x1 <= span.x1 && hides(nearness, other.nearness,
                                        {begin, direction(0.5 * (span.x0 + other.x1)), other.end});
  });
  open_.push_back({span.x1, nearness, end, number});
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
    show(strip_[open_.front().strip], from, to);
    return;
  }
  const double centre = 0.5 * (from + to);
  const Vec3 begin = direction(from), end = direction(to);
  const Open& middle = nearest(direction(centre));
  const Open &first = nearest(begin), &last = nearest(end);
  const auto is_nearest = [&](const Open& best, Vec3 d) {
    return dot(best.nearness - middle.nearness, d) <= kTouching * dot(best.nearness, d);
  };
  constexpr int kDepth = 16;
  if ((is_nearest(first, begin) && is_nearest(last, end)) || depth == kDepth) {
    show(strip_[middle.strip], from, to);
    return;
  }
  const double at = order_changes(last.nearness - first.nearness, from, to);
  resolve(from, at, depth + 1);
  resolve(at, to, depth + 1);
}

/// What is visible of a strip is shown from left to right.
void VisibleSpans::show(Strip& strip, double from, double to) {
  while (strip.next < strip.end && spans_[strip.next].x1 <= from) ++strip.next;
  for (std::size_t k = strip.next; k < strip.end && spans_[k].x0 < to; ++k) {
    const DiscSpan& span = spans_[k];
    length_[span.seen] += std::max(0.0, std::min(span.x1, to) - std::max(span.x0, from));
  }
}

const VisibleSpans::Open& VisibleSpans::nearest(Vec3 direction) const {
  return *std::max_element(open_.begin(), open_.end(), [&](const Open& a, const Open& b) {
    return dot(a.nearness, direction) < dot(b.nearness, direction);
  });
}

/// Where dot(difference, direction(x)) is 0, or else the middle. On the line x = r cos t and z = r
/// sin t, so that a cos(t - t0) = -b.
double VisibleSpans::order_changes(Vec3 difference, double from, double to) const {
  const double r = std::sqrt(std::max(0.0, 1.0 - y_ * y_));
  const double a = r * std::hypot(difference.x, difference.z), b = y_ * difference.y;
  if (a > std::abs(b)) {
    const double middle = std::atan2(difference.z, difference.x), half = std::acos(-b / a);
    for (const double t : {middle + half, middle - half}) {
      const double at = r * std::cos(t);
      if (std::sin(t) >= 0.0 && at > from && at < to) return at;
    }
  }
  return 0.5 * (from + to);  // not between these two
}

}  // namespace tenku
