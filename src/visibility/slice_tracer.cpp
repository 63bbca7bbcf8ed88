#include "visibility/slice_tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace tenku {
namespace {

constexpr std::uint32_t kNone = MeshAdjacency::kNone;
constexpr double kHalfPi = std::numbers::pi / 2.0;
constexpr int kMostSteps = 2000;  // along one mesh; longer chains are cut, and the check tells
constexpr int kMostClimbs = 48;
constexpr double kTouching = 1e-4;  // radians between two surfaces that count as one
constexpr double kBeyond = 1e-5;    // radians past an outline at which the next ray is sent

}  // namespace

void VisibleSlice::remove(const Altitude& low, const Altitude& high) {
  if (!(high.radians > low.radians)) return;
  VisibleSlice kept;
  const auto keep = [&](const Altitude& a, const Altitude& b) {
    if (!(b.radians > a.radians) || kept.count == kMaximum) return;
    kept.range[static_cast<std::size_t>(kept.count++)] = {a, b};
  };
  for (int i = 0; i < count; ++i) {
    const auto [a, b] = range[static_cast<std::size_t>(i)];
    keep(a, b.radians < low.radians ? b : low);    // what lies below the part taken away
    keep(a.radians > high.radians ? a : high, b);  // and above
  }
  count = kept.count;
  range = kept.range;
}

SliceTracer::SliceTracer(const RayVisibility& rays, Vec3 origin) : rays_(rays), origin_(origin) {}

Vec3 SliceTracer::direction(const Altitude& altitude) const {
  return {altitude.cosine * plane_.along.x, altitude.cosine * plane_.along.y, altitude.sine};
}

SliceTracer::Corner SliceTracer::corner(std::uint32_t vertex) const {
  const Vec3 at = rays_.soup().vertices[vertex] - origin_;
  return {at, at.x * plane_.across.x + at.y * plane_.across.y};
}

bool SliceTracer::crosses(std::uint32_t triangle) const {
  const auto& corners = rays_.soup().triangles[triangle];
  const Corner a = corner(corners[0]), b = corner(corners[1]), c = corner(corners[2]);
  if (!parted(a, b) && !parted(b, c)) return false;
  // Cut by the whole plane; the slice is the half of it in front.
  return (parted(a, b) && edge_point(a, b).r > 0.0) || (parted(b, c) && edge_point(b, c).r > 0.0) ||
         (parted(c, a) && edge_point(c, a).r > 0.0);
}

SliceTracer::PlanePoint SliceTracer::edge_point(const Corner& a, const Corner& b) const {
  // The mean of the ends, weighted by how far the other lies beside the plane; not divided by the
  // weights, as only ratios and signs of what comes out matter on the way.
  const double of_a = std::abs(b.side), of_b = std::abs(a.side);
  const double x = of_a * a.at.x + of_b * b.at.x, y = of_a * a.at.y + of_b * b.at.y;
  return {x * plane_.along.x + y * plane_.along.y, of_a * a.at.z + of_b * b.at.z, of_a + of_b};
}

SliceTracer::Outline SliceTracer::follow(std::uint32_t triangle, int sense) const {
  const auto& soup = rays_.soup();
  // Turning from p to q by the sense of the walk: positive if q lies further that way.
  const auto turn = [&](PlanePoint p, PlanePoint q) { return sense * (p.r * q.z - p.z * q.r); };
  unsigned edge = 0;
  PlanePoint best{};
  Corner from, to;  // of the edge
  bool found = false;
  for (unsigned e = 0; e < 3; ++e) {
    const Corner a = corner(soup.triangles[triangle][e]);
    const Corner b = corner(soup.triangles[triangle][(e + 1) % 3]);
    if (!parted(a, b)) continue;
    const PlanePoint p = edge_point(a, b);
    if (!found || turn(best, p) > 0.0) best = p, edge = e, from = a, to = b, found = true;
  }
  for (int step = 0; step < kMostSteps; ++step) {
    if (best.r <= 0.0) break;  // over the zenith
    const std::uint32_t across_edge = rays_.adjacency().opposite(triangle, edge);
    if (across_edge == kNone) break;
    const std::uint32_t next = across_edge / 3;
    const unsigned entry = across_edge % 3;
    const auto& corners = soup.triangles[next];
    // Surfaces may have vertices of their own at the same place.
    if (soup.vertices[corners[entry]] - origin_ != from.at) std::swap(from, to);
    const Corner third = corner(corners[(entry + 2) % 3]);
    const bool beside_from = !parted(from, third);
    const PlanePoint p = beside_from ? edge_point(to, third) : edge_point(third, from);
    if (!(turn(best, p) > 0.0)) break;
    best = p;
    triangle = next;
    edge = beside_from ? (entry + 1) % 3 : (entry + 2) % 3;
    (beside_from ? from : to) = third;
  }
  const Altitude altitude = best.r > 0.0   ? Altitude::of_slope(best.z / best.r)
                            : best.z > 0.0 ? Altitude::zenith()
                                           : Altitude{};
  const auto& corners = soup.triangles[triangle];
  return {altitude,
          triangle,
          std::sqrt(best.r * best.r + best.z * best.z) / best.scale,
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

Altitude SliceTracer::find_end(const Altitude& start, const Altitude& limit, int sense, End& end,
                               const std::array<std::uint32_t, 2>& hints) {
  // The first ray leaves a little higher: along the ground it would meet the very feet of things,
  // which rounding may miss.
  Altitude at = start;
  double beyond = kBeyond, step_out = kBeyond;
  end.edge = {};
  const auto passed = [&](const Altitude& a) { return sense * (a.radians - limit.radians) >= 0.0; };
  const auto try_hint = [&](std::uint32_t hint) {
    const std::uint32_t known = cut_near(hint);
    if (known == kNone) return;
    const Outline outline = follow(known, sense);
    if (!(sense * (outline.altitude.radians - at.radians) > 0.0)) return;
    // It bounds this slice too only if it hides all from the start on.
    if (sense * (follow(known, -sense).altitude.radians - start.radians) > kTouching) return;
    at = outline.altitude;
    end = {known, outline.edge};
  };
  const std::uint32_t last = end.hint;
  try_hint(last);
  if (hints[0] != last) try_hint(hints[0]);
  if (hints[1] != last && hints[1] != hints[0]) try_hint(hints[1]);
  for (int climb = 0; climb < kMostClimbs && !passed(at); ++climb) {
    ++rays_sent_;
    const Altitude probed = at.turned(sense * beyond);
    const auto hit = rays_.first_hit(origin_, direction(probed));
    if (!hit) return at;
    at = probed;
    if (crosses(hit->triangle)) {
      const Outline outline = follow(hit->triangle, sense);
      if (sense * (outline.altitude.radians - probed.radians) > 0.0) {
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

VisibleSlice SliceTracer::trace(Vec3 along, const Altitude& low, const Altitude& high,
                                SliceHints before, SliceHints after) {
  plane_ = {along, {along.y, -along.x, 0.0}};
  VisibleSlice slice;
  if (!(high.radians > low.radians)) return slice;
  const Altitude bottom =
      find_end(low, high, +1, low_end_, {before.low_triangle, after.low_triangle});
  slice.hints.low_triangle = low_end_.hint;
  if (!(bottom.radians < high.radians)) return slice;
  const bool top_is_open = high.radians >= kHalfPi && zenith_is_open();
  if (top_is_open) high_end_.edge = {};
  const Altitude top = top_is_open ? high
                                   : find_end(high, bottom, -1, high_end_,
                                              {before.high_triangle, after.high_triangle});
  if (!(top.radians > bottom.radians)) return slice;
  slice.count = 1;
  slice.range[0] = {bottom, top};
  slice.low_edge = low_end_.edge;
  slice.high_edge = high_end_.edge;
  slice.hints = {low_end_.hint, high_end_.hint};
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
  return rays_.glass_transmission(origin_, direction(Altitude::of(altitude_rad)));
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
  const Vec3 toward = direction(Altitude::of(altitude_rad));
  if (!claimed) return !rays_.is_occluded(origin_, toward);
  const auto hit = rays_.first_hit(origin_, toward);
  if (!hit) return true;
  if (crosses(hit->triangle)) remember(hit->triangle);
  return false;
}

}  // namespace tenku
