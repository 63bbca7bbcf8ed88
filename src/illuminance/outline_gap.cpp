#include "illuminance/outline_gap.h"

#include <algorithm>
#include <cmath>

namespace tenku {
namespace {

constexpr int kMostHalvings = 6;
constexpr int kCrossingSteps = 3;
constexpr double kPiece = 0.05;                 // radians of altitude for two angles through panes
constexpr double kGauss = 0.28867513459481287;  // their places: two-point rule on a unit length

/// Where the outlines of a slice end, toward `limit`.
Bearing reach_after(const SkySlice& left, const Bearing& from, const Bearing& limit) {
  Bearing reach = limit;
  if (left.low.exists()) reach = left.low.end_after(from, reach);
  if (left.high.exists()) reach = left.high.end_after(from, reach);
  return reach;
}

Bearing reach_before(const SkySlice& right, const Bearing& from, const Bearing& limit) {
  Bearing reach = limit;
  if (right.low.exists()) reach = right.low.end_before(from, reach);
  if (right.high.exists()) reach = right.high.end_before(from, reach);
  return reach;
}

/// Arc tangent; error below 2e-8.
///
/// Source   M. Abramowitz, I. Stegun, "Handbook of Mathematical Functions", 4.4.49.
double arc_tangent(double x) {
  const double size = std::abs(x);
  const bool steep = size > 1.0;
  const double t = steep ? 1.0 / size : size, u = t * t;
  double sum = 0.0028662257;
  for (const double coefficient : {-0.0161657367, 0.0429096138, -0.0752896400, 0.1065626393,
                                   -0.1420889944, 0.1999355085, -0.3333314528, 1.0}) {
    sum = sum * u + coefficient;
  }
  const double angle = steep ? kPi / 2.0 - t * sum : t * sum;
  return x < 0.0 ? -angle : angle;
}

}  // namespace

int append_pieces(const SensorSight& sight, Vec3 along, double low, double high,
                  std::vector<SeenPiece>& pieces) {
  if (!sight.rays.has_glass()) {
    pieces.push_back({low, high, 1.0});
    return 0;
  }
  const int parts = std::max(1, static_cast<int>(std::ceil((high - low) / kPiece)));
  const double step = (high - low) / parts;
  const auto transmitted = [&](double altitude) {
    const double c = std::cos(altitude);
    return sight.rays.glass_transmission(sight.origin,
                                         {c * along.x, c * along.y, std::sin(altitude)});
  };
  for (int k = 0; k < parts; ++k) {
    const double from = low + k * step, middle = from + 0.5 * step;
    pieces.push_back({from, middle, transmitted(middle - kGauss * step)});
    pieces.push_back({middle, from + step, transmitted(middle + kGauss * step)});
  }
  return 2 * parts;
}

OutlineGap::OutlineGap(const SkySlice& left, const SkySlice& right, double width_rad,
                       const SensorSight& sight)
    : left_(left), right_(right), width_(width_rad), sight_(sight) {
  const Bearing begin{0.0, left.along}, end{width_, right.along};
  left_reach_ = left.is_outlined ? reach_after(left, begin, end) : begin;
  right_reach_ = right.is_outlined ? reach_before(right, end, begin) : end;
  // What hides all of a slice hides on, until an edge that the other one has met gives way.
  const auto ends_inside = [&](const Bearing& b) { return b.offset > 0.0 && b.offset < width_; };
  if (!left.is_open && right.is_outlined && ends_inside(right_reach_)) left_reach_ = right_reach_;
  if (!right.is_open && left.is_outlined && ends_inside(left_reach_)) right_reach_ = left_reach_;
  // A slice that knows better than the edges of the other one, but not how far.
  const bool left_objects = !left.is_outlined && !left.is_behind && !(right_reach_.offset > 0.0);
  const bool right_objects =
      !right.is_outlined && !right.is_behind && !(left_reach_.offset < width_);
  if (left_objects) right_reach_ = end;
  if (right_objects) left_reach_ = begin;
}

LuxAndView OutlineGap::seen(const Bearing& bearing, Sides sides) const {
  if ((sides.left && !left_.is_open) || (sides.right && !right_.is_open)) return {};
  const SliceLight light(sight_.table, sight_.normal, left_.azimuth + bearing.offset,
                         bearing.along);
  auto [low, high] = light.front();
  const auto bound = [&](const SkySlice& side) {
    if (side.low.exists()) low = std::max(low, arc_tangent(side.low.slope(bearing.along)));
    if (side.high.exists()) high = std::min(high, arc_tangent(side.high.slope(bearing.along)));
  };
  if (sides.left) bound(left_);
  if (sides.right) bound(right_);
  if (!(low < high)) return {};
  if (!sight_.rays.has_glass()) return light.both(low, high);
  std::vector<SeenPiece> pieces;
  rays_sent_ += static_cast<std::uint64_t>(append_pieces(sight_, bearing.along, low, high, pieces));
  LuxAndView sum;
  for (const SeenPiece& p : pieces) sum = sum + p.transmittance * light.both(p.low, p.high);
  return sum;
}

LuxAndView OutlineGap::at(const Bearing& bearing) const {
  const double offset = bearing.offset;
  const bool left = offset <= left_reach_.offset, right = offset >= right_reach_.offset;
  if (left || right) return seen(bearing, {left, right});
  const double share = (offset - left_reach_.offset) / hole();
  return (1.0 - share) * left_end() + share * right_end();
}

LuxAndView OutlineGap::open_at(const Bearing& bearing) const {
  const SliceLight light(sight_.table, sight_.normal, left_.azimuth + bearing.offset,
                         bearing.along);
  const auto [low, high] = light.front();
  return low < high ? light.both(low, high) : LuxAndView{};
}

LuxAndView OutlineGap::left_end() const {
  return left_reach_.offset > 0.0 ? seen(left_reach_, {true, false}) : left_.light;
}

LuxAndView OutlineGap::right_end() const {
  return right_reach_.offset < width_ ? seen(right_reach_, {false, true}) : right_.light;
}

Bearing OutlineGap::crossing(Bearing from, Bearing to) const {
  if (!left_.low.exists() || !right_.low.exists()) return to;
  const auto height = [&](const Bearing& b) {
    return left_.low.slope(b.along) - right_.low.slope(b.along);
  };
  double h_from = height(from), h_to = height(to);
  if (!(h_from * h_to < 0.0)) return to;
  Bearing at = to;
  for (int step = 0; step < kCrossingSteps; ++step) {
    const double share = h_from / (h_from - h_to);
    at.offset = from.offset + share * (to.offset - from.offset);
    at.along = normalized((1.0 - share) * from.along + share * to.along);
    const double h = height(at);
    if (h * h_from > 0.0) {
      from = at, h_from = h;
    } else {
      to = at, h_to = h;
    }
  }
  return at;
}

LuxAndView OutlineGap::known(double negligible_lux) const {
  const bool overlap = right_reach_.offset < left_reach_.offset;
  const Bearing& first = overlap ? right_reach_ : left_reach_;
  const Bearing& last = overlap ? left_reach_ : right_reach_;
  LuxAndView sum = sum_between({true, false}, {0.0, left_.along}, first, negligible_lux) +
                   sum_between({false, true}, last, {width_, right_.along}, negligible_lux);
  if (!overlap) return sum;
  const Bearing middle = crossing(first, last);
  return sum + sum_between({true, true}, first, middle, negligible_lux) +
         sum_between({true, true}, middle, last, negligible_lux);
}

LuxAndView OutlineGap::sum_between(Sides sides, const Bearing& from, const Bearing& to,
                                   double negligible_lux) const {
  if (!(from.offset < to.offset)) return {};
  const auto node = [&](const Bearing& b) {
    if (b.offset == 0.0 && sides.left) return Node{b, left_.light};
    if (b.offset == width_ && sides.right) return Node{b, right_.light};
    return Node{b, seen(b, sides)};
  };
  return simpson(sides, node(from), node(to), negligible_lux, kMostHalvings);
}

LuxAndView OutlineGap::simpson(Sides sides, const Node& a, const Node& b, double negligible_lux,
                               int depth) const {
  const double width = b.bearing.offset - a.bearing.offset;
  const Bearing middle = middle_of(a.bearing, b.bearing);
  const Node m{middle, seen(middle, sides)};
  const LuxAndView trapezoid = (0.5 * width) * (a.light + b.light);
  const LuxAndView sum = (width / 6.0) * (a.light + 4.0 * m.light + b.light);
  if (depth == 0 || std::abs(sum.lux - trapezoid.lux) <= negligible_lux) return sum;
  return simpson(sides, a, m, 0.5 * negligible_lux, depth - 1) +
         simpson(sides, m, b, 0.5 * negligible_lux, depth - 1);
}

}  // namespace tenku
