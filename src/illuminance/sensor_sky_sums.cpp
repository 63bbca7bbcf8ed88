// What the slices of a sensor tell: the light between them, and how sure it is.

#include <algorithm>
#include <cmath>

#include "illuminance/sensor_sky.h"

namespace tenku {
namespace {

// When outlines are believed.
constexpr int kTests = 4;            // that they must have stood
constexpr double kMuchBetter = 0.5;  // of the squares of what the mean of the neighbours misses
constexpr double kFewPlaces = 0.1;   // of the gaps hold what is not known

// What they tell.
constexpr double kMissed = 0.4;       // of what the neighbours of a slice missed is missed still
constexpr double kDoubt = 2.0;        // misses that might be of steps known by now
constexpr double kPriorTests = 2.0;   // before any test so many count as made,
constexpr double kPriorMiss = 0.5;    // and so much of the light as missed in them
constexpr double kLeastKnown = 1e-4;  // radians of azimuth, where nothing was tested
constexpr double kPriorShare = 0.25;  // of the open sky that a hole shows
constexpr double kBounded = 0.3;      // of its variance an even error has less far from its mean

constexpr double square(double x) { return x * x; }

/// Of things that no slice has met, in a part of a gap between two tests.
/// @param miss_squared  the squares of what the tests missed, added
constexpr double unknown_variance(double width, double miss_squared) {
  return square(width) / 5.0 * miss_squared;
}

}  // namespace

SensorSky::GapLight SensorSky::gap_light(std::size_t i) {
  const OutlineGap gap(at(i), at(i + 1), width_after(i), sight_);
  GapLight result;
  result.is_fine = is_whole_;
  result.known = gap.known(is_whole_);
  result.hole_width = gap.hole();
  if (result.hole_width > 0.0) {
    const LuxAndView begin = gap.left_end(), end = gap.right_end();
    result.hole = (0.5 * result.hole_width) * (begin + end);
    result.step = (end - begin).lux;
  }
  pane_rays_ += gap.rays_sent();
  if (!(result.hole_width > 0.0)) return result;
  result.hole_begin = gap.hole_begin().offset;
  result.is_blind = !gap.is_between_outlines();
  if (!result.is_blind) {
    const Bearing middle = middle_of(gap.hole_begin(), gap.hole_end());
    result.room = gap.hole() * gap.open_at(middle) - result.hole;
  }
  return result;
}

SensorSky::Test SensorSky::test_of(std::size_t i) {
  const double left = width_after(before(i)), right = width_after(i);
  const OutlineGap without(at(before(i)), at(i + 1), left + right, sight_);
  const Bearing here{left, at(i).along};
  const LuxAndView foretold = without.at(here);
  pane_rays_ += without.rays_sent();
  Test test;
  test.kind = Test::Kind::Known;
  test.miss = at(i).light - foretold;
  if (!without.is_in_hole(left)) return test;
  test.kind = without.is_between_outlines() ? Test::Kind::Hole : Test::Kind::Blind;
  test.room = without.open_at(here).lux - foretold.lux;
  return test;
}

/// Chance that the next outline is one that no slice has met, after Good and Turing: the share of
/// those met but once.
double SensorSky::unseen_share() {
  met_.clear();
  for (const Entry& entry : entry_) {
    if (!entry.slice.is_outlined) continue;
    for (const OutlineEdge& edge : {entry.slice.low_edge, entry.slice.high_edge}) {
      if (edge.a == MeshAdjacency::kNone) continue;
      const std::uint64_t first = std::min(edge.a, edge.b), last = std::max(edge.a, edge.b);
      met_.push_back(first << 32 | last);
    }
  }
  std::sort(met_.begin(), met_.end());
  int once = 0;
  for (auto from = met_.begin(); from != met_.end();) {
    const auto to = std::upper_bound(from, met_.end(), *from);
    if (to - from == 1) ++once;
    from = to;
  }
  return (once + 1.0) / (static_cast<double>(met_.size()) + 1.0);
}

/// Floating parts that lie between slices.
void SensorSky::find_unmet_parts() {
  unmet_.assign(entry_.size(), 0.0);
  if (sight_.table == nullptr || !effort_.outlined || !effort_.sure_of_parts) return;
  if (sight_.rays.floating_parts().empty()) return;
  for (const SliceTracer::SeenPart& part : tracer_.parts()) {
    const auto from_first = [&](double azimuth) {
      const double turns = (azimuth - at(0).azimuth) / (2.0 * kPi);
      return at(0).azimuth + 2.0 * kPi * (turns - std::floor(turns));
    };
    const double azimuth = from_first(part.azimuth_rad());
    const auto after = std::upper_bound(
        entry_.begin(), entry_.end(), azimuth,
        [](double value, const Entry& entry) { return value < entry.slice.azimuth; });
    const auto gap = static_cast<std::size_t>(after - entry_.begin()) - 1;
    const double left = azimuth - at(gap).azimuth, right = width_after(gap) - left;
    if (!at(gap).is_open && !at(gap + 1).is_open) continue;
    if (std::min(left, right) < part.half_width_rad()) continue;  // met
    const double lux = part.solid_angle() / kPi * part.sine() * sight_.table->horizontal_lux();
    if (lux > 0.0) unmet_[gap] += square(lux) / 3.0;
  }
}

/// Whether all that bounds the sky is among what the slices have met.
bool SensorSky::is_whole() {
  if (!has_boundary_) {
    const auto pieces = sky_boundary(sight_.rays, sight_.origin, sight_.normal, pane_rays_);
    if (pieces) boundary_.emplace(pieces->begin(), pieces->end());
    has_boundary_ = true;
  }
  if (!boundary_) return false;
  for (std::size_t i = 0; i < entry_.size(); ++i) {
    const OutlineGap gap(at(i), at(i + 1), width_after(i), sight_);
    const auto is_met = [&](const BoundaryOutline& part) { return gap.ends_along(part); };
    if (!std::all_of(boundary_->begin(), boundary_->end(), is_met)) return false;
  }
  return true;
}

void SensorSky::learn(double about_lux) {
  const std::size_t count = entry_.size();
  is_whole_ = is_whole();
  for (std::size_t i = 0; i < count; ++i) {
    Entry &here = entry_[i], &next = entry_[(i + 1) % count];
    if (here.is_new || next.is_new || (is_whole_ && !here.gap.is_fine)) here.gap = gap_light(i);
    if (here.is_new || next.is_new || entry_[before(i)].is_new) here.test = test_of(i);
  }
  for (Entry& entry : entry_) entry.is_new = false;
  lesson_ = {};
  const double prior =
      is_whole_ ? 0.0
                : kPriorTests * std::sqrt(unseen_share()) * 2.0 * kPi / static_cast<double>(count);
  double known = 0.0, room = 0.0, filled = 0.0, room_squared = 0.0;
  double missed = 0.0, missed_squared = 0.0, tested_squared = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Test& test = entry_[i].test;
    // A slice close to its neighbour tells less of a wide gap.
    const double width = std::min(width_after(before(i)), width_after(i));
    if (test.kind == Test::Kind::Hole) {
      room += test.room;
      filled += test.miss.lux;
      room_squared += square(test.room);
    }
    if (test.kind != Test::Kind::Known) continue;
    const double bend = at(i).light.lux - 0.5 * (at(before(i)).light.lux + at(i + 1).light.lux);
    ++lesson_.known;
    known += width;
    lesson_.miss = lesson_.miss + width * test.miss;
    lesson_.miss_squared += width * square(test.miss.lux);
    tested_squared += width * square(to_lose(entry_[i]));
    missed += std::abs(width * test.miss.lux);
    missed_squared += square(width * test.miss.lux);
    lesson_.bend_squared += width * square(bend);
  }
  // Misses as many as count: one or two of them tell of steps that are known by now.
  const double misses = missed_squared > 0.0 ? square(missed) / missed_squared : 0.0;
  lesson_.evidence = misses / (misses + kDoubt);
  const double imagined = prior * open_squared();
  if (tested_squared + imagined > 0.0) {
    lesson_.relative_squared =
        (lesson_.miss_squared + imagined * square(kPriorMiss)) / (tested_squared + imagined);
  }
  lesson_.bend_squared /= std::max({known, prior, kLeastKnown});
  known = std::max(known + prior, kLeastKnown);
  lesson_.miss = (1.0 / known) * lesson_.miss;
  lesson_.miss_squared += prior * square(kPriorMiss * about_lux / (2.0 * kPi));
  lesson_.miss_squared /= known;
  // The share of holes: a ratio of sums, with two tests' worth of what is usual beforehand.
  const double typical = room > 0.0 ? room_squared / room : 1.0;
  lesson_.share = (filled + 2.0 * kPriorShare * typical) / (room + 2.0 * typical);
  double scatter = 2.0 * square(typical) / 12.0;
  for (const Entry& entry : entry_) {
    if (entry.test.kind != Test::Kind::Hole) continue;
    scatter += square(entry.test.miss.lux - lesson_.share * entry.test.room);
  }
  lesson_.share_variance = scatter / (room_squared + 2.0 * square(typical));
  lesson_.share_error = scatter / square(room + 2.0 * typical);
}

/// Light per radian that a slice has, or was foretold.
double SensorSky::to_lose(const Entry& entry) {
  const double found = entry.slice.light.lux;
  return std::max(found, found - entry.test.miss.lux);
}

/// Mean square of the light where some is seen.
double SensorSky::open_squared() const {
  double sum = 0.0, open = 0.0;
  for (std::size_t i = 0; i < entry_.size(); ++i) {
    if (!at(i).is_open) continue;
    const double width = width_after(before(i)) + width_after(i);
    open += width;
    sum += width * square(at(i).light.lux);
  }
  return open > 0.0 ? sum / open : 0.0;
}

/// Of what a slice tells nothing of, lux^2 per radian^2.
double SensorSky::unknown_squared(const Entry& entry) const {
  const double pooled = lesson_.relative_squared * square(to_lose(entry));
  return entry.test.kind == Test::Kind::Known ? std::max(pooled, square(entry.test.miss.lux))
                                              : pooled;
}

/// Of the light in a gap, by what is not known of it.
double SensorSky::gap_variance(std::size_t i) const {
  const GapLight& gap = entry_[i].gap;
  const double width = width_after(i);
  if (!at(i).is_open && !at(i + 1).is_open) return 0.0;
  if (gap.is_blind) {
    return unmet_[i] + square(gap.hole_width * gap.step) / 12.0 +
           unknown_variance(width, lesson_.relative_squared *
                                       (square(at(i).light.lux) + square(at(i + 1).light.lux)));
  }
  const Entry& next = entry_[(i + 1) % entry_.size()];
  const double known = width - gap.hole_width;
  return unmet_[i] + lesson_.share_variance * square(gap.room.lux) +
         unknown_variance(known, unknown_squared(entry_[i]) + unknown_squared(next));
}

SensorSky::Sum SensorSky::even_sum() const {
  const double pitch = 2.0 * kPi / static_cast<double>(entry_.size());
  const auto goes_on = [](const SkySlice& a, const SkySlice& b) {
    return a.is_outlined && b.is_outlined && a.low.touches(b.low) && a.high.touches(b.high);
  };
  Sum sum;
  bool is_left_on = goes_on(at(entry_.size() - 1), at(0));
  for (std::size_t i = 0; i < entry_.size(); ++i) {
    const SkySlice &left = at(before(i)), &here = at(i), &right = at(i + 1);
    sum.light = sum.light + pitch * here.light;
    sum.variance += unmet_[i];
    const double bend = here.light.lux - 0.5 * (left.light.lux + right.light.lux);
    const bool was_on = is_left_on;
    is_left_on = goes_on(here, right);
    if (!was_on || !is_left_on) {
      sum.variance += square(pitch * bend) * (1.0 / 6.0 + kScatter / (3.0 * pitch));
      continue;
    }
    const double rise = 0.5 * (right.light.lux - left.light.lux) / pitch;
    sum.variance += square(pitch) * (square(bend) / 120.0 + square(rise * kScatter) / 12.0);
  }
  return sum;
}

/// Whether outlines foretell much better than the mean of the neighbours, or what they leave open
/// lies in few places.
bool SensorSky::outlines_tell() const {
  if (lesson_.known >= kTests && lesson_.miss_squared <= kMuchBetter * lesson_.bend_squared) {
    return true;
  }
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < entry_.size(); ++i) {
    const double variance = gap_variance(i);
    sum += variance;
    squares += square(variance);
  }
  return square(sum) <= kFewPlaces * squares * slices();
}

SensorSky::Sum SensorSky::outlined_sum() const {
  Sum sum;
  double room = 0.0, known = 0.0, blind_squares = 0.0, columns = 0.0;
  for (std::size_t i = 0; i < entry_.size(); ++i) {
    const GapLight& gap = entry_[i].gap;
    sum.light = sum.light + gap.known + gap.hole + lesson_.share * gap.room;
    room += gap.room.lux;
    if (sight_.table != nullptr) {
      columns += sight_.table->column_error(at(i).azimuth, width_after(i)) * gap.known.lux;
    }
    known += gap.is_blind ? 0.0 : width_after(i) - gap.hole_width;
    const double variance = gap_variance(i);
    sum.variance += variance;
    if (gap.is_blind) blind_squares += square(variance);
  }
  const LuxAndView missed = (known * kMissed) * lesson_.miss;
  sum.light = sum.light + lesson_.evidence * missed;
  sum.variance +=
      (square(1.0 - lesson_.evidence) + square(0.35 * lesson_.evidence)) * square(missed.lux);
  sum.variance += lesson_.share_error * square(room);
  // One step at an unknown place is off by no more than it is high; several by more.
  if (sum.variance > 0.0) {
    sum.variance *= 1.0 - kBounded * square(blind_squares / square(sum.variance));
  }
  sum.variance += square(kTable * sum.light.lux) + square(columns);
  return sum;
}

}  // namespace tenku
