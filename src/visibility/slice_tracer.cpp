#include "visibility/slice_tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tenku {
namespace {

constexpr std::uint32_t kNone = MeshAdjacency::kNone;
constexpr double kHalfPi = std::numbers::pi / 2.0;
constexpr int kMostSteps = 2000;  // along one mesh; longer chains are cut, and the check tells
constexpr int kMostClimbs = 48;
constexpr double kTouching = 1e-4;  // radians between two surfaces that count as one
constexpr double kBeyond = 1e-5;    // radians past an outline at which the next ray is sent

}  // namespace

void VisibleSlice::remove(double low, double high) {
  if (!(high > low)) return;
  VisibleSlice kept;
  const auto keep = [&](double a, double b) {
    if (b > a && kept.count < kMaximum) kept.range[static_cast<std::size_t>(kept.count++)] = {a, b};
  };
  for (int i = 0; i < count; ++i) {
    const auto [a, b] = range[static_cast<std::size_t>(i)];
    keep(a, std::min(b, low));   // what lies below the part taken away
    keep(std::max(a, high), b);  // and above
  }
  count = kept.count;
  range = kept.range;
}

SliceTracer::SliceTracer(const RayVisibility& rays, Vec3 origin) : rays_(rays), origin_(origin) {}

Vec3 SliceTracer::direction(double altitude_rad) const {
  if (altitude_rad == 0.0) return plane_.along;
  const double c = std::cos(altitude_rad), s = std::sin(altitude_rad);
  return {c * plane_.along.x, c * plane_.along.y, s};
}

double SliceTracer::across(std::uint32_t vertex) const {
  const Vec3& v = rays_.soup().vertices[vertex];
  return (v.x - origin_.x) * plane_.across.x + (v.y - origin_.y) * plane_.across.y;
}

bool SliceTracer::crosses(std::uint32_t triangle) const {
  const auto& [a, b, c] = rays_.soup().triangles[triangle];
  const bool sa = across(a) >= 0.0, sb = across(b) >= 0.0, sc = across(c) >= 0.0;
  if (sa == sb && sb == sc) return false;
  // Cut by the whole plane; the slice is the half of it in front.
  return (sa != sb && edge_point(a, b).r > 0.0) || (sb != sc && edge_point(b, c).r > 0.0) ||
         (sc != sa && edge_point(c, a).r > 0.0);
}

SliceTracer::PlanePoint SliceTracer::edge_point(std::uint32_t a, std::uint32_t b) const {
  const double sa = across(a), sb = across(b);
  const double t = sa / (sa - sb);
  const Vec3 &p = rays_.soup().vertices[a], &q = rays_.soup().vertices[b];
  const double x = p.x + t * (q.x - p.x) - origin_.x, y = p.y + t * (q.y - p.y) - origin_.y;
  return {x * plane_.along.x + y * plane_.along.y, p.z + t * (q.z - p.z) - origin_.z};
}

SliceTracer::Outline SliceTracer::follow(std::uint32_t triangle, int sense) const {
  const auto& soup = rays_.soup();
  // Turning from p to q by the sense of the walk: positive if q lies further that way.
  const auto turn = [&](PlanePoint p, PlanePoint q) { return sense * (p.r * q.z - p.z * q.r); };
  unsigned edge = 0;
  PlanePoint best{};
  bool found = false;
  for (unsigned e = 0; e < 3; ++e) {
    const std::uint32_t a = soup.triangles[triangle][e], b = soup.triangles[triangle][(e + 1) % 3];
    if ((across(a) >= 0.0) == (across(b) >= 0.0)) continue;
    const PlanePoint p = edge_point(a, b);
    if (!found || turn(best, p) > 0.0) best = p, edge = e, found = true;
  }
  for (int step = 0; step < kMostSteps; ++step) {
    if (best.r <= 0.0) break;  // over the zenith
    const std::uint32_t across_edge = rays_.adjacency().opposite(triangle, edge);
    if (across_edge == kNone) break;
    const std::uint32_t next = across_edge / 3;
    const unsigned entry = across_edge % 3;
    const auto& corners = soup.triangles[next];
    const std::uint32_t a = corners[entry], b = corners[(entry + 1) % 3],
                        c = corners[(entry + 2) % 3];
    const bool beside_a = (across(a) >= 0.0) == (across(c) >= 0.0);
    const PlanePoint p = beside_a ? edge_point(b, c) : edge_point(c, a);
    if (!(turn(best, p) > 0.0)) break;
    best = p;
    triangle = next;
    edge = beside_a ? (entry + 1) % 3 : (entry + 2) % 3;
  }
  const double altitude =
      best.r <= 0.0 ? (best.z > 0.0 ? kHalfPi : 0.0) : std::atan2(best.z, best.r);
  const auto& corners = soup.triangles[triangle];
  return {altitude,
          triangle,
          std::sqrt(best.r * best.r + best.z * best.z),
          {corners[edge], corners[(edge + 1) % 3]}};
}

std::uint32_t SliceTracer::cut_near(std::uint32_t triangle) const {
  if (triangle == kNone || crosses(triangle)) return triangle;
  for (unsigned e = 0; e < 3; ++e) {
    const std::uint32_t other = rays_.adjacency().opposite(triangle, e);
    if (other != kNone && crosses(other / 3)) return other / 3;
  }
  return kNone;
}

double SliceTracer::find_end(double start, double limit, int sense, End& end) {
  // The first ray leaves a little higher: along the ground it would meet the very feet of things,
  // which rounding may miss.
  double at = start, beyond = kBeyond, step_out = kBeyond;
  end.edge = {};
  const auto passed = [&](double altitude) { return sense * (altitude - limit) >= 0.0; };
  const std::uint32_t known = cut_near(end.hint);
  if (known != kNone) {
    const Outline outline = follow(known, sense);
    // It bounds this slice too only if it hides all from the start on.
    const bool reaches_back = sense * (follow(known, -sense).altitude - at) <= kTouching;
    if (reaches_back && sense * (outline.altitude - at) > 0.0) {
      at = outline.altitude;
      beyond = kBeyond;
      end = {known, outline.edge};
    }
  }
  for (int climb = 0; climb < kMostClimbs && !passed(at); ++climb) {
    ++rays_sent_;
    const auto hit = rays_.first_hit(origin_, direction(at + sense * beyond));
    if (!hit) return at;
    const double probed = at + sense * beyond;
    at = probed;
    if (crosses(hit->triangle)) {
      const Outline outline = follow(hit->triangle, sense);
      if (sense * (outline.altitude - probed) > 0.0) {
        at = outline.altitude;
        step_out = kBeyond + 2.0 * rays_.lift_m() / std::max(outline.distance, 1e-3);
        end = {outline.triangle, outline.edge};
        beyond = step_out;
        continue;
      }
    }
    beyond = step_out *= 2.0;  // the outline is rounder than the numbers: move on
  }
  return limit;
}

bool SliceTracer::zenith_is_open() {
  if (zenith_ < 0) {
    ++rays_sent_;
    zenith_ = rays_.is_occluded(origin_, kZenith) ? 0 : 1;
  }
  return zenith_ == 1;
}

VisibleSlice SliceTracer::trace(Vec3 along, double low, double high) {
  plane_ = {along, {along.y, -along.x, 0.0}};
  VisibleSlice slice;
  if (!(high > low)) return slice;
  const double bottom = find_end(low, high, +1, low_end_);
  if (!(bottom < high)) return slice;
  const bool top_is_open = high >= kHalfPi && zenith_is_open();
  if (top_is_open) high_end_.edge = {};
  const double top = top_is_open ? high : find_end(high, bottom, -1, high_end_);
  if (!(top > bottom)) return slice;
  slice.count = 1;
  slice.range[0] = {bottom, top};
  slice.low_edge = low_end_.edge;
  slice.high_edge = high_end_.edge;
  for (int i = 0; i < floating_count_; ++i) {
    std::uint32_t& triangle = floating_[static_cast<std::size_t>(i)];
    const std::uint32_t cut = cut_near(triangle);
    if (cut == kNone) continue;
    triangle = cut;
    slice.remove(follow(cut, -1).altitude, follow(cut, +1).altitude);
  }
  return slice;
}

double SliceTracer::glass_transmission(double altitude_rad) {
  ++rays_sent_;
  return rays_.glass_transmission(origin_, direction(altitude_rad));
}

void SliceTracer::remember(std::uint32_t triangle) {
  for (int i = 0; i < floating_count_; ++i) {
    if (floating_[static_cast<std::size_t>(i)] == triangle) return;
  }
  floating_[static_cast<std::size_t>(floating_next_)] = triangle;
  floating_next_ = (floating_next_ + 1) % kFloating;
  floating_count_ = std::min(floating_count_ + 1, kFloating);
}

bool SliceTracer::check(double altitude_rad, bool claimed) {
  ++rays_sent_;
  if (!claimed) return !rays_.is_occluded(origin_, direction(altitude_rad));
  const auto hit = rays_.first_hit(origin_, direction(altitude_rad));
  if (!hit) return true;
  if (crosses(hit->triangle)) remember(hit->triangle);
  return false;
}

}  // namespace tenku
