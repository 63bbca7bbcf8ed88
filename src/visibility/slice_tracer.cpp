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

SliceTracer::SliceTracer(const RayVisibility& rays, Vec3 origin, double least_part_rad)
    : rays_(rays), origin_(origin), least_part_rad_(least_part_rad) {}

Vec3 SliceTracer::direction(const Altitude& altitude) const {
  return {altitude.cosine * plane_.along.x, altitude.cosine * plane_.along.y, altitude.sine};
}

SliceTracer::Corner SliceTracer::corner(std::uint32_t vertex) const {
  const Vec3 at = rays_.soup().vertices[vertex] - origin_;
  return {at, at.x * plane_.across.x + at.y * plane_.across.y};
}

SliceTracer::PlanePoint SliceTracer::edge_point(const Corner& a, const Corner& b) const {
  // The mean of the ends, weighted by how far the other lies beside the plane; not divided by the
  // weights, as only ratios and signs of what comes out matter on the way.
  const double of_a = std::abs(b.side), of_b = std::abs(a.side);
  const double x = of_a * a.at.x + of_b * b.at.x, y = of_a * a.at.y + of_b * b.at.y;
  return {x * plane_.along.x + y * plane_.along.y, of_a * a.at.z + of_b * b.at.z, of_a + of_b};
}

std::array<SliceTracer::Corner, 3> SliceTracer::corners(std::uint32_t triangle) const {
  const auto& [a, b, c] = rays_.soup().triangles[triangle];
  return {corner(a), corner(b), corner(c)};
}

bool SliceTracer::cut(std::uint32_t triangle, const std::array<Corner, 3>& at, Cut& result) const {
  const bool first = parted(at[0], at[1]), second = parted(at[1], at[2]);
  if (!first && !second) return false;
  result.triangle = triangle;
  result.edge = {first ? 0U : 1U, first && second ? 1U : 2U};
  for (std::size_t k = 0; k < 2; ++k) {
    result.point[k] = edge_point(at[result.edge[k]], at[(result.edge[k] + 1) % 3]);
  }
  // Cut by the whole plane; the slice is the half of it in front.
  return result.point[0].r > 0.0 || result.point[1].r > 0.0;
}

SliceTracer::Outline SliceTracer::follow(const Cut& start, int sense) const {
  const auto& soup = rays_.soup();
  // Turning from p to q by the sense of the walk: positive if q lies further that way.
  const auto turn = [&](PlanePoint p, PlanePoint q) { return sense * (p.r * q.z - p.z * q.r); };
  const std::size_t further = turn(start.point[0], start.point[1]) > 0.0 ? 1 : 0;
  std::uint32_t triangle = start.triangle;
  unsigned edge = start.edge[further];
  PlanePoint best = start.point[further];
  Corner from = corner(soup.triangles[triangle][edge]);  // of the edge
  Corner to = corner(soup.triangles[triangle][(edge + 1) % 3]);
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
  const auto& corners = soup.triangles[triangle];
  return {best, triangle, {corners[edge], corners[(edge + 1) % 3]}};
}

Altitude SliceTracer::Outline::altitude() const {
  if (point.r > 0.0) return Altitude::of_slope(point.z / point.r);
  return point.z > 0.0 ? Altitude::zenith() : Altitude{};
}

double SliceTracer::Outline::distance() const {
  return std::sqrt(point.r * point.r + point.z * point.z) / point.scale;
}

bool SliceTracer::Outline::is_past(const Altitude& other, int sense, double by_rad) const {
  if (!(point.r > 0.0)) return sense * (altitude().radians - other.radians) > by_rad;
  const double turned = sense * (point.z * other.cosine - point.r * other.sine);
  // The sine of an angle near 180 degrees is as small as that of none.
  const bool is_opposite = point.r * other.cosine + point.z * other.sine < 0.0;
  if (!(by_rad > 0.0) || is_opposite) return turned > 0.0;
  return turned > by_rad * std::sqrt(point.r * point.r + point.z * point.z);
}

bool SliceTracer::cut_near(std::uint32_t triangle, Cut& result) const {
  if (triangle == kNone) return false;
  const auto& soup = rays_.soup();
  const std::array<Corner, 3> at = corners(triangle);
  if (parted(at[0], at[1]) || parted(at[1], at[2])) {
    if (cut(triangle, at, result)) return true;
  }
  for (unsigned e = 0; e < 3; ++e) {
    const std::uint32_t other = rays_.adjacency().opposite(triangle, e);
    if (other == kNone) continue;
    // It shares two corners: where these lie on one side the third decides.
    const Corner third = corner(soup.triangles[other / 3][(other % 3 + 2) % 3]);
    if (!parted(at[e], at[(e + 1) % 3]) && !parted(at[e], third)) continue;
    if (cut(other / 3, result)) return true;
  }
  return false;
}

Altitude SliceTracer::find_end(const Altitude& start, const Altitude& limit, int sense, End& end,
                               const std::array<std::uint32_t, 2>& hints) {
  // The first ray leaves a little higher: along the ground it would meet the very feet of things,
  // which rounding may miss.
  Altitude at = start;
  double beyond = kBeyond, step_out = kBeyond;
  end.edge = {};
  const auto passed = [&](const Altitude& a) { return sense * (a.radians - limit.radians) >= 0.0; };
  Cut known, met;
  const auto try_hint = [&](std::uint32_t hint) {
    if (!cut_near(hint, known)) return;
    const Outline outline = follow(known, sense);
    if (!outline.is_past(at, sense)) return;
    // It bounds this slice too only if it hides all from the start on.
    if (follow(known, -sense).is_past(start, sense, kTouching)) return;
    at = outline.altitude();
    end = {known.triangle, outline.edge};
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
    if (cut(hit->triangle, met)) {
      const Outline outline = follow(met, sense);
      if (outline.is_past(probed, sense)) {
        at = outline.altitude();
        step_out = kBeyond + 2.0 * rays_.lift_m() / std::max(outline.distance(), 1e-3);
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
  for (const SeenPart& part : parts()) {
    const double beside = part.to.x * plane_.across.x + part.to.y * plane_.across.y;
    if (std::abs(beside) >= part.radius) continue;
    const double ahead = part.to.x * plane_.along.x + part.to.y * plane_.along.y;
    if (ahead > -part.radius && !part.is_below(bottom)) remove_part(part.index, slice);
  }
  for (int i = 0; i < floating_count_; ++i) {
    std::uint32_t& triangle = floating_[static_cast<std::size_t>(i)];
    Cut known;
    if (!cut_near(triangle, known)) continue;
    triangle = known.triangle;
    slice.remove(follow(known, -1).altitude(), follow(known, +1).altitude());
  }
  return slice;
}

const std::vector<SliceTracer::SeenPart>& SliceTracer::parts() {
  if (has_parts_) return parts_;
  has_parts_ = true;
  const FloatingParts& floating = rays_.floating_parts();
  if (floating.empty() || least_part_rad_ == kNoParts) return parts_;
  std::vector<std::uint32_t> found;
  floating.around(origin_, kMostParts, least_part_rad_, found);
  parts_.reserve(found.size());
  for (const std::uint32_t i : found) {
    const FloatingPart& part = floating[i];
    const Vec3 to = part.middle - origin_;
    parts_.push_back({i, to, std::sqrt(to.x * to.x + to.y * to.y), part.radius,
                      0.5 * (part.highest - part.lowest)});
  }
  return parts_;
}

double SliceTracer::SeenPart::azimuth_rad() const { return std::atan2(to.x, to.y); }

double SliceTracer::SeenPart::half_width_rad() const {
  return radius < level ? std::asin(radius / level) : std::numbers::pi;
}

double SliceTracer::SeenPart::solid_angle() const {
  const double distance = std::max(length(to), 1e-9);
  const double share = std::min(1.0, radius / distance);
  const double tall = std::hypot(half_height, radius * std::abs(to.z) / distance);
  return std::min(2.0 * std::numbers::pi, 4.0 * share * tall / distance);
}

double SliceTracer::SeenPart::sine() const { return to.z / std::max(length(to), 1e-9); }

void SliceTracer::remove_part(std::uint32_t part, VisibleSlice& slice) const {
  const FloatingParts& floating = rays_.floating_parts();
  const auto altitude = [](double r, double z) { return Altitude::of_slope(z / r); };
  for (const std::uint32_t t : floating.triangles(floating[part])) {
    if (slice.count == 0) return;
    const std::array<Corner, 3> at = corners(t);
    Cut crossed;
    if (!cut(t, at, crossed)) continue;
    const PlanePoint &p = crossed.point[0], &q = crossed.point[1];
    if (p.r > 0.0 && q.r > 0.0) {
      const Altitude a = altitude(p.r, p.z), b = altitude(q.r, q.z);
      slice.remove(a.radians < b.radians ? a : b, a.radians < b.radians ? b : a);
      continue;
    }
    // One end lies behind: from the other end it hides all to the zenith, or to the nadir.
    const PlanePoint &ahead = p.r > 0.0 ? p : q, &behind = p.r > 0.0 ? q : p;
    const Altitude end = altitude(ahead.r, ahead.z);
    const bool is_over = behind.z * ahead.r - ahead.z * behind.r > 0.0;
    slice.remove(is_over ? end : Altitude{}, is_over ? Altitude::zenith() : end);
  }
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
  if (Cut met; cut(hit->triangle, met)) remember(hit->triangle);
  return false;
}

}  // namespace tenku
