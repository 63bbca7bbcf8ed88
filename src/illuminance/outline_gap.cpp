#include "illuminance/outline_gap.h"

#include <algorithm>
#include <cmath>

namespace tenku {
namespace {

constexpr double kNarrow = 0.01;  // radians of azimuth for which one half-plane stands
constexpr int kCrossingSteps = 3;
constexpr double kPiece = 0.05;                 // radians of altitude for two angles through panes
constexpr double kGauss = 0.28867513459481287;  // their places: two-point rule on a unit length

constexpr double kSpeck = 1e-4;       // radians of azimuth of a boundary's part too short to test
constexpr double kBesideEdge = 3e-4;  // radians from an edge, to tell the sky from what hides it

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

}  // namespace

const OutlineGap::Cutting OutlineGap::kCoarse{.most_bend = 1e-4, .most_width = kPi, .halvings = 6};
const OutlineGap::Cutting OutlineGap::kFine{.most_bend = 1e-6, .most_width = 0.05, .halvings = 16};

int append_pieces(const SensorSight& sight, Vec3 along, const Altitude& low, const Altitude& high,
                  std::vector<SeenPiece>& pieces) {
  if (!sight.rays.has_glass()) {
    pieces.push_back({low, high, 1.0});
    return 0;
  }
  const int parts = std::max(1, static_cast<int>(std::ceil((high.radians - low.radians) / kPiece)));
  const double step = (high.radians - low.radians) / parts;
  const auto transmitted = [&](double altitude) {
    const double c = std::cos(altitude);
    return sight.rays.glass_transmission(sight.origin,
                                         {c * along.x, c * along.y, std::sin(altitude)});
  };
  for (int k = 0; k < parts; ++k) {
    const double from = low.radians + k * step, middle = from + 0.5 * step;
    const Altitude a = Altitude::of(from), b = Altitude::of(middle), c = Altitude::of(from + step);
    pieces.push_back({a, b, transmitted(middle - kGauss * step)});
    pieces.push_back({b, c, transmitted(middle + kGauss * step)});
  }
  return 2 * parts;
}

LuxAndView light_through(const SliceLight& light, std::span<const SeenPiece> pieces) {
  LuxAndView sum;
  for (const SeenPiece& p : pieces) sum = sum + p.transmittance * light.both(p.low, p.high);
  return sum;
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

OutlineGap::Range OutlineGap::range_at(const SliceLight& light, Vec3 along, Sides sides) const {
  Range range{light.low(), light.high()};
  const auto bound = [&](const SkySlice& side) {
    if (side.low.exists()) {
      const Altitude low = Altitude::of_slope(side.low.slope(along));
      if (low.sine > range.low.sine) range.low = low;
    }
    if (side.high.exists()) {
      const Altitude high = Altitude::of_slope(side.high.slope(along));
      if (high.sine < range.high.sine) range.high = high;
    }
  };
  if (sides.left) bound(left_);
  if (sides.right) bound(right_);
  return range;
}

LuxAndView OutlineGap::seen(const Bearing& bearing, Sides sides) const {
  if ((sides.left && !left_.is_open) || (sides.right && !right_.is_open)) return {};
  const SliceLight light(sight_.table, sight_.normal, left_.azimuth + bearing.offset,
                         bearing.along);
  const auto [low, high] = range_at(light, bearing.along, sides);
  if (!(low.sine < high.sine)) return {};
  if (!sight_.rays.has_glass()) return light.both(low, high);
  std::vector<SeenPiece> pieces;
  rays_sent_ += static_cast<std::uint64_t>(append_pieces(sight_, bearing.along, low, high, pieces));
  return light_through(light, pieces);
}

LuxAndView OutlineGap::at(const Bearing& bearing) const {
  const double offset = bearing.offset;
  const bool left = offset <= left_reach_.offset, right = offset >= right_reach_.offset;
  if (left || right) return seen(bearing, {left, right});
  const double share = (offset - left_reach_.offset) / hole();
  return (1.0 - share) * left_end() + share * right_end();
}

std::optional<bool> OutlineGap::shows(const Bearing& bearing, double sine) const {
  if (is_in_hole(bearing.offset)) return std::nullopt;
  const Sides sides{bearing.offset <= left_reach_.offset, bearing.offset >= right_reach_.offset};
  if ((sides.left && !left_.is_open) || (sides.right && !right_.is_open)) return false;
  const SliceLight light(nullptr, sight_.normal, 0.0, bearing.along);
  const auto [low, high] = range_at(light, bearing.along, sides);
  return low.sine < sine && sine < high.sine;
}

bool OutlineGap::ends_along(const BoundaryOutline& outline) const {
  const double turn = outline.turn;
  const double middle_from_middle =
      std::remainder(outline.begin + 0.5 * turn - left_.azimuth - 0.5 * width_, 2.0 * kPi);
  const double begin = middle_from_middle + 0.5 * (width_ - turn);
  const double from = std::max(0.0, begin), to = std::min(width_, begin + turn);
  if (to < from || to - from < std::min(kSpeck, 0.5 * turn)) return true;
  const double offset = 0.5 * (from + to), azimuth = left_.azimuth + offset;
  const Vec3 along{std::sin(azimuth), std::cos(azimuth), 0.0};
  const Vec3 middle = normalized(along + outline.edge.slope(along) * kZenith);
  const auto is_told = [&](double beside) {
    const Vec3 toward = normalized(middle + beside * outline.outward);
    const Vec3 level = normalized({toward.x, toward.y, 0.0});
    const double at = offset + along.y * level.x - along.x * level.y;
    if (at < 0.0 || at > width_) return true;  // past a slice
    const std::optional<bool> sky = shows({at, level}, toward.z);
    return !sky || *sky == (beside > 0.0);
  };
  return is_told(kBesideEdge) && is_told(-kBesideEdge);
}

LuxAndView OutlineGap::open_at(const Bearing& bearing) const {
  const SliceLight light(sight_.table, sight_.normal, left_.azimuth + bearing.offset,
                         bearing.along);
  return light.is_behind() ? LuxAndView{} : light.both(light.low(), light.high());
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

LuxAndView OutlineGap::known(bool is_fine) const {
  const Cutting& cutting = is_fine ? kFine : kCoarse;
  const bool overlap = right_reach_.offset < left_reach_.offset;
  const Bearing& first = overlap ? right_reach_ : left_reach_;
  const Bearing& last = overlap ? left_reach_ : right_reach_;
  LuxAndView sum = sum_between({true, false}, {0.0, left_.along}, first, cutting) +
                   sum_between({false, true}, last, {width_, right_.along}, cutting);
  if (!overlap) return sum;
  const Bearing middle = crossing(first, last);
  return sum + sum_between({true, true}, first, middle, cutting) +
         sum_between({true, true}, middle, last, cutting);
}

double OutlineGap::bend(const Bearing& from, const Bearing& middle, const Bearing& to,
                        Sides sides) const {
  double most = 0.0;
  const auto add = [&](const OutlineSegment& edge) {
    if (!edge.exists()) return;
    const double here = edge.slope(middle.along);
    const auto rise_to = [&](const Bearing& end) {  // sine of the angle between two altitudes
      const double there = edge.slope(end.along);
      return (there - here) / std::sqrt((1.0 + there * there) * (1.0 + here * here));
    };
    most = std::max(most, 0.5 * std::abs(rise_to(from) + rise_to(to)));
  };
  if (sides.left) add(left_.low), add(left_.high);
  if (sides.right) add(right_.low), add(right_.high);
  return most;
}

LuxAndView OutlineGap::sum_between(Sides sides, const Bearing& from, const Bearing& to,
                                   const Cutting& cutting, int depth) const {
  const double width = to.offset - from.offset;
  if (!(width > 0.0)) return {};
  const Bearing middle = middle_of(from, to);
  const bool is_wide =
      width > cutting.most_width || bend(from, middle, to, sides) * width > cutting.most_bend;
  if (is_wide && depth < cutting.halvings) {
    return sum_between(sides, from, middle, cutting, depth + 1) +
           sum_between(sides, middle, to, cutting, depth + 1);
  }
  if (width < kNarrow) return width * seen(middle, sides);
  const auto node = [&](double share) {
    return Bearing{from.offset + share * width,
                   normalized((1.0 - share) * from.along + share * to.along)};
  };
  return (0.5 * width) * (seen(node(0.5 - kGauss), sides) + seen(node(0.5 + kGauss), sides));
}

}  // namespace tenku
