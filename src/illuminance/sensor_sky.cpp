#include "illuminance/sensor_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace tenku {
namespace {

constexpr int kRareCheck = 4;          // one slice in so many is checked while all goes well
constexpr int kDenseChecks = 4;        // rays a checked slice, where the checks dominate the error
constexpr double kPiece = 0.05;        // radians of altitude over which panes count as one angle
constexpr double kWorthHalving = 0.2;  // of the worst gap's error
constexpr std::size_t kLookInto = 8;   // one gap in so many is halved in any case

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
    : rays_(rays),
      table_(table),
      normal_(normal),
      random_(random),
      effort_(effort),
      tracer_(rays, position + rays.lift_m() * normal),
      start_(2.0 * kPi * random_.uniform()) {}

SensorSky::SensorSky(const RayVisibility& rays, const SkyTable* table, Vec3 position, Vec3 normal,
                     SampleRandom random)
    : SensorSky(rays, table, position, normal, random, Effort{}) {}

void SensorSky::refine() {
  if (resolved_) {
    halve_gaps();
  } else {
    double_evenly();
    resolved_ = effort_.halving && is_resolved() && has_sure_claims();
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
    const std::size_t next = (i + 1) % count;
    error[i] = std::sqrt(gap_sum(i, slopes_at(i), slopes_at(next)).variance +
                         0.5 * (misfit_variance(i) + misfit_variance(next)));
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
    if (expected_smooth &&
        (gap_between(at(i), middle) == Gap::Step || gap_between(middle, at(i + 1)) == Gap::Step)) {
      surprise_variance_ += square(width * (middle.lux - 0.5 * (at(i).lux + at(i + 1).lux)));
    }
    refined.push_back(middle);
  }
  slice_ = std::move(refined);
}

/// Whether one outline goes on into the other, also from one object to the next.
bool SensorSky::touch(OutlineEdge a, OutlineEdge b) const {
  if (a.touches(b)) return true;
  if (a.a == MeshAdjacency::kNone || b.a == MeshAdjacency::kNone) return false;
  const auto& v = rays_.soup().vertices;
  return v[a.a] == v[b.a] || v[a.a] == v[b.b] || v[a.b] == v[b.a] || v[a.b] == v[b.b];
}

SensorSky::Gap SensorSky::gap_between(const Slice& a, const Slice& b) const {
  // A sensor that looks level sees along its own surface there: its light sets in like a sine.
  if (a.is_behind != b.is_behind) return Gap::Kink;
  if (a.ranges != b.ranges || a.ranges > 1) return Gap::Step;
  if (a.low_edge == b.low_edge && a.high_edge == b.high_edge) return Gap::Smooth;
  return touch(a.low_edge, b.low_edge) && touch(a.high_edge, b.high_edge) ? Gap::Kink : Gap::Step;
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
  return slices() >= kFewestToHalve && crowded == 0 && 4 * steps <= slice_.size() &&
         seeing_ >= kSeeing;
}

/// Whether the checks have nothing more to tell: slices of halved gaps are not checked.
bool SensorSky::has_sure_claims() const {
  constexpr double kSure = 1e-4;  // of the value
  return checks_.lux_squared <= square(kSure * lux_) && (table_ != nullptr || checks_.view == 0.0);
}

double SensorSky::width_after(std::size_t i) const {
  const double width = at(i + 1).azimuth - slice_[i].azimuth;
  return i + 1 < slice_.size() ? width : width + 2.0 * kPi;
}

/// A parabola through three slices, or a line through two, all on smooth sides.
SensorSky::Slopes SensorSky::slopes_at(std::size_t i) const {
  const std::size_t count = slice_.size(), before = (i + count - 1) % count;
  const bool left = is_smooth_after(before), right = is_smooth_after(i);
  if (!left && !right) return {};
  const auto rise = [&](std::size_t k) {  // slopes of the chord of a gap
    const double width = width_after(k % count);
    const Slice &a = at(k), &b = at(k + 1);
    return Slopes{(b.lux - a.lux) / width, (b.view - a.view) / width, true};
  };
  const auto mix = [](double p, Slopes a, Slopes b) {
    return Slopes{p * a.lux + (1.0 - p) * b.lux, p * a.view + (1.0 - p) * b.view, true};
  };
  if (left && right) {
    const double wl = width_after(before), wr = width_after(i);
    return mix(wr / (wl + wr), rise(before), rise(i));
  }
  const std::size_t near = right ? i : before;
  const std::size_t next = right ? (i + 1) % count : (i + count - 2) % count;
  if (!is_smooth_after(next)) return rise(near);
  const double wn = width_after(near), wf = width_after(next);
  return mix(1.0 + wn / (wn + wf), rise(near), rise(next));
}

double SensorSky::misfit_at(std::size_t i) const {
  const std::size_t count = slice_.size();
  if (count < 5) return 0.0;
  std::array<double, 4> x{}, y{};
  std::size_t points = 0;
  const auto take = [&](std::size_t k, double distance) {
    x[points] = distance;
    y[points++] = at(k).lux;
  };
  const std::size_t b1 = (i + count - 1) % count, b2 = (i + count - 2) % count;
  if (!is_smooth_after(b1) || !is_smooth_after(i)) return 0.0;
  take(b1, -width_after(b1));
  if (is_smooth_after(b2)) take(b2, -width_after(b1) - width_after(b2));
  take(i + 1, width_after(i));
  if (is_smooth_after((i + 1) % count)) take(i + 2, width_after(i) + width_after((i + 1) % count));
  double expected = 0.0;  // Lagrange's polynomial at distance 0
  for (std::size_t k = 0; k < points; ++k) {
    double weight = 1.0;
    for (std::size_t m = 0; m < points; ++m) {
      if (m != k) weight *= x[m] / (x[m] - x[k]);
    }
    expected += weight * y[k];
  }
  return at(i).lux - expected;
}

double SensorSky::misfit_variance(std::size_t i) const {
  const double width =
      0.5 * (width_after(i) + width_after((i + slice_.size() - 1) % slice_.size()));
  return square(width * misfit_at(i)) / 120.0;
}

SensorSky::GapSum SensorSky::gap_sum(std::size_t i, const Slopes& before,
                                     const Slopes& after) const {
  const Slice &here = at(i), &next = at(i + 1);
  const Gap gap = gap_between(here, next);
  const double width = width_after(i), bend = square(width) * (after.lux - before.lux);
  GapSum sum{0.5 * width * (here.lux + next.lux), 0.5 * width * (here.view + next.view), 0.0};
  if (!before.known || !after.known) {
    // Nothing tells how either side goes on.
    sum.variance = square(width * (next.lux - here.lux)) / 12.0;
    return sum;
  }
  const double share = gap == Gap::Step ? 1.0 / 6.0 : 1.0 / 12.0;
  sum.lux -= share * bend;
  sum.view -= share * square(width) * (after.view - before.view);
  const double height = next.lux - here.lux - 0.5 * width * (before.lux + after.lux);
  if (gap == Gap::Step) sum.variance = square(width * height) / 12.0 + square(bend / 12.0);
  if (gap == Gap::Kink) sum.variance = square(bend) / 720.0;
  return sum;
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
  slice.is_behind = !(work.front.low < work.front.high);
  if (slice.is_behind) return slice;
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
    const GapSum gap = gap_sum(i, before, after);
    sum.lux += gap.lux;
    sum.view += gap.view;
    sum.variance += gap.variance + misfit_variance(i);
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
