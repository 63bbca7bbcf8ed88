#include "illuminance/sensor_sky.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tenku {
namespace {

constexpr int kRareCheck = 4;       // one slice in so many is checked while all goes well
constexpr int kDenseChecks = 4;     // rays a checked slice, where the checks dominate the error
constexpr double kPiece = 0.1;      // radians of altitude over which panes count as one angle
constexpr double kWorthHalving = 0.2;  // of the worst gap's error
constexpr std::size_t kLookInto = 8;   // one gap in so many is halved in any case
constexpr double kSmoothShare = 0.05;  // of the correction for the slopes: what is wrong with it

constexpr double square(double x) { return x * x; }

}  // namespace

struct SensorSky::Work {
  double along;  ///< component of the normal toward the azimuth
  double up;
  FrontRange front;
  std::optional<SkyTable::Column> column;
  VisibleSlice visible;

  double weighted(SliceMoments m) const { return along * m.along + up * m.up; }
  double view(double from, double to) const {
    return weighted(uniform_moments(to) - uniform_moments(from)) / kPi;
  }
  double lux(double from, double to) const {
    return column ? weighted(column->to(to) - column->to(from)) : 0.0;
  }
  /// What checks are drawn in proportion to: skylight, or the view of a uniform sky without one.
  double measure(double from, double to) const { return column ? lux(from, to) : view(from, to); }
  SkyTable::Column::Row row_reaching(double wanted, double low, double high) const {
    if (!column) return {low, high};
    return column->row_reaching(wanted + weighted(column->to(low)), along, up, low, high);
  }
};

SensorSky::SensorSky(const RayVisibility& rays, const SkyTable* table, Vec3 position, Vec3 normal,
                     SampleRandom random, Effort effort)
    : rays_(rays), table_(table), normal_(normal), random_(random), effort_(effort),
      tracer_(rays, position + rays.lift_m() * normal), start_(2.0 * kPi * random_.uniform()) {}

SensorSky::SensorSky(const RayVisibility& rays, const SkyTable* table, Vec3 position, Vec3 normal,
                     SampleRandom random)
    : SensorSky(rays, table, position, normal, random, Effort{}) {}

void SensorSky::refine() {
  if (resolved_) {
    halve_gaps();
  } else {
    double_evenly();
    resolved_ = effort_.halving && is_resolved();
  }
  summarise();
}

void SensorSky::double_evenly() {
  const std::size_t old = slice_.size();
  const std::size_t count = old == 0 ? static_cast<std::size_t>(effort_.first_slices) : 2 * old;
  const double pitch = 2.0 * kPi / static_cast<double>(count);
  const bool all_well = old > 0 && checks_.lux_squared == 0.0 && checks_.view == 0.0;
  const int checks = checks_.lux_squared > 0.5 * variance_ ? kDenseChecks : 1;
  // All slices stand for half as much azimuth as before, and so do their checks.
  checks_ = {0.5 * checks_.lux, 0.5 * checks_.view, 0.25 * checks_.lux_squared};
  std::vector<Slice> refined(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (old > 0 && i % 2 == 0) {
      refined[i] = slice_[i / 2];
      continue;
    }
    const double azimuth =
        start_ + pitch * static_cast<double>(i) + kScatter * (random_.uniform() - 0.5);
    const bool checked = effort_.checked && (!all_well || (i / 2) % kRareCheck == 0);
    refined[i] = make_slice(azimuth, checked ? checks : 0, pitch * (all_well ? kRareCheck : 1));
  }
  slice_ = std::move(refined);
}

void SensorSky::halve_gaps() {
  const std::size_t count = slice_.size();
  std::vector<double> error(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double width = width_after(i);
    const double correction =
        square(width) / 12.0 * (slopes_at((i + 1) % count).lux - slopes_at(i).lux);
    error[i] = gap_error(gap_between(at(i), at(i + 1)), width, at(i + 1).lux - at(i).lux, correction);
  }
  const double worst = *std::max_element(error.begin(), error.end());
  std::vector<Slice> refined;
  refined.reserve(count + count / 4);
  surprise_variance_ = 0.0;
  ++halvings_;
  for (std::size_t i = 0; i < count; ++i) {
    refined.push_back(slice_[i]);
    const bool is_worst = error[i] > kWorthHalving * worst;
    const bool is_look = (i + halvings_) % kLookInto == 0;
    if (!is_worst && !is_look) continue;
    const double width = width_after(i);
    const Slice middle =
        make_slice(slice_[i].azimuth + width * (0.4 + 0.2 * random_.uniform()), 0, 0.0);
    const bool expected_smooth = gap_between(at(i), at(i + 1)) != Gap::Step;
    if (expected_smooth && (gap_between(at(i), middle) == Gap::Step ||
                            gap_between(middle, at(i + 1)) == Gap::Step)) {
      surprise_variance_ += square(width * (middle.lux - 0.5 * (at(i).lux + at(i + 1).lux)));
    }
    refined.push_back(middle);
  }
  slice_ = std::move(refined);
}

SensorSky::Gap SensorSky::gap_between(const Slice& a, const Slice& b) {
  if (a.ranges != b.ranges || a.ranges > 1) return Gap::Step;
  if (a.low_edge == b.low_edge && a.high_edge == b.high_edge) return Gap::Smooth;
  return a.low_edge.touches(b.low_edge) && a.high_edge.touches(b.high_edge) ? Gap::Kink
                                                                            : Gap::Step;
}

/// Few steps, none next to another: then the slices show all there is, as far as they can tell.
bool SensorSky::is_resolved() {
  std::size_t steps = 0, crowded = 0;
  seeing_ = 0;
  bool before = gap_between(at(slice_.size() - 1), at(0)) == Gap::Step;
  for (std::size_t i = 0; i < slice_.size(); ++i) {
    const bool step = gap_between(at(i), at(i + 1)) == Gap::Step;
    steps += step;
    crowded += step && before;
    seeing_ += slice_[i].ranges > 0;
    before = step;
  }
  return crowded == 0 && 4 * steps <= slice_.size() && seeing_ >= kSeeing;
}

double SensorSky::width_after(std::size_t i) const {
  const double width = at(i + 1).azimuth - slice_[i].azimuth;
  return i + 1 < slice_.size() ? width : width + 2.0 * kPi;
}

/// Slopes at a slice, from the neighbours that no step separates from it.
SensorSky::Slopes SensorSky::slopes_at(std::size_t i) const {
  const std::size_t count = slice_.size(), before = (i + count - 1) % count;
  const Slice &here = at(i), &left = at(before), &right = at(i + 1);
  const double wl = width_after(before), wr = width_after(i);
  double to_left = gap_between(left, here) != Gap::Step ? wr / (wl + wr) : 0.0;
  double to_right = gap_between(here, right) != Gap::Step ? wl / (wl + wr) : 0.0;
  // A parabola through three slices, or a line through two.
  if (to_left == 0.0 && to_right > 0.0) to_right = 1.0;
  if (to_right == 0.0 && to_left > 0.0) to_left = 1.0;
  return {to_left * (here.lux - left.lux) / wl + to_right * (right.lux - here.lux) / wr,
          to_left * (here.view - left.view) / wl + to_right * (right.view - here.view) / wr};
}

double SensorSky::gap_error(Gap gap, double width, double height, double correction) {
  if (gap == Gap::Step) return width * std::abs(height) / std::sqrt(12.0);
  return (gap == Gap::Kink ? 1.0 : kSmoothShare) * std::abs(correction);
}

SensorSky::Slice SensorSky::make_slice(double azimuth_rad, int checks, double weight) {
  Work work;
  const double sine = std::sin(azimuth_rad), cosine = std::cos(azimuth_rad);
  work.along = normal_.x * sine + normal_.y * cosine;
  work.up = normal_.z;
  work.front = front_range(work.along, work.up);
  Slice slice;
  slice.azimuth = azimuth_rad;
  slice.ranges = 1;
  if (!(work.front.low < work.front.high)) return slice;
  if (table_ != nullptr) work.column = table_->column(azimuth_rad);
  work.visible = tracer_.trace({sine, cosine, 0.0}, work.front.low, work.front.high);
  claim(work);
  slice.low_edge = work.visible.low_edge;
  slice.high_edge = work.visible.high_edge;
  slice.ranges = work.visible.count;
  for (const auto& [range, transmittance] : piece_) {
    slice.lux += transmittance * work.lux(range.low, range.high);
    slice.view += transmittance * work.view(range.low, range.high);
  }
  if (checks > 0) check(work, checks, weight);
  return slice;
}

void SensorSky::claim(Work& work) {
  piece_.clear();
  for (int i = 0; i < work.visible.count; ++i) {
    const AltitudeRange whole = work.visible.range[static_cast<std::size_t>(i)];
    if (!rays_.has_glass()) {
      piece_.push_back({whole, 1.0});
      continue;
    }
    const int parts = std::max(1, static_cast<int>(std::ceil((whole.high - whole.low) / kPiece)));
    const double step = (whole.high - whole.low) / parts;
    for (int k = 0; k < parts; ++k) {
      const AltitudeRange part{whole.low + k * step, whole.low + (k + 1) * step};
      piece_.push_back({part, tracer_.glass_transmission(0.5 * (part.low + part.high))});
    }
  }
}

void SensorSky::check(const Work& work, int checks, double weight) {
  const auto [low, high] = work.front;
  const double whole = work.measure(low, high);
  if (!(whole > 0.0)) return;
  double lux = 0.0, view = 0.0;
  for (int k = 0; k < checks; ++k) {
    // A row of the table in proportion to its light, then any altitude in it alike.
    const double wanted = whole * (k + random_.uniform()) / checks;
    const auto [a, b] = work.row_reaching(wanted, low, high);
    const double altitude = a + (b - a) * random_.uniform();
    const double chance = work.measure(a, b) / whole;
    if (!(chance > 0.0)) continue;
    double claimed = 0.0;
    for (const auto& [range, transmittance] : piece_) {
      if (altitude >= range.low && altitude <= range.high) claimed = transmittance;
    }
    double truth = tracer_.check(altitude, claimed > 0.0) ? 1.0 : 0.0;
    if (truth > 0.0 && rays_.has_glass()) truth = tracer_.glass_transmission(altitude);
    const double missed = truth - claimed;
    if (missed == 0.0) continue;
    lux += missed * work.lux(a, b) / chance;
    view += missed * work.view(a, b) / chance;
  }
  lux *= weight / checks;
  checks_.lux += lux;
  checks_.view += view * weight / checks;
  checks_.lux_squared += square(lux);
}

SensorSky::Sum SensorSky::even_sum() const {
  const std::size_t count = slice_.size();
  const double pitch = 2.0 * kPi / static_cast<double>(count);
  Sum sum;
  for (std::size_t i = 0; i < count; ++i) {
    const Slice &before = at(i + count - 1), &here = slice_[i], &after = at(i + 1);
    sum.lux += pitch * here.lux;
    sum.view += pitch * here.view;
    const double bend = here.lux - 0.5 * (before.lux + after.lux);
    if (gap_between(before, here) == Gap::Step || gap_between(here, after) == Gap::Step) {
      sum.variance += square(pitch * bend) * (1.0 / 6.0 + kScatter / (3.0 * pitch));
      continue;
    }
    // A kink of slope change c gives sum(bend^2) = (wc)^2 / 6 and a variance of w^4 c^2 / 720.
    const double rise = 0.5 * (after.lux - before.lux) / pitch;
    sum.variance += square(pitch) * (square(bend) / 120.0 + square(rise * kScatter) / 12.0);
  }
  return sum;
}

SensorSky::Sum SensorSky::halved_sum() const {
  Sum sum;
  Slopes before = slopes_at(0);
  const Slopes first = before;
  for (std::size_t i = 0; i < slice_.size(); ++i) {
    const Slopes after = i + 1 < slice_.size() ? slopes_at(i + 1) : first;
    const Slice &here = at(i), &next = at(i + 1);
    const double width = width_after(i);
    sum.lux += 0.5 * width * (here.lux + next.lux);
    sum.view += 0.5 * width * (here.view + next.view);
    const Gap gap = gap_between(here, next);
    const double correction = square(width) / 12.0 * (after.lux - before.lux);
    if (gap != Gap::Step) {
      sum.lux -= correction;
      sum.view -= square(width) / 12.0 * (after.view - before.view);
    }
    sum.variance += square(gap_error(gap, width, next.lux - here.lux, correction));
    before = after;
  }
  sum.variance += surprise_variance_;
  return sum;
}

void SensorSky::summarise() {
  const Sum sum = resolved_ ? halved_sum() : even_sum();
  lux_ = sum.lux + checks_.lux;
  sky_view_ = std::clamp(sum.view + checks_.view, 0.0, 1.0);
  variance_ = sum.variance + checks_.lux_squared;
}

}  // namespace tenku
