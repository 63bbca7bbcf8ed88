#include "illuminance/sensor_sky.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tenku {
namespace {

constexpr int kRareCheck = 4;       // one slice in so many is checked while all goes well
constexpr int kDenseChecks = 4;     // rays a checked slice, where the checks dominate the error
constexpr double kPiece = 0.1;      // radians of altitude over which panes count as one angle
constexpr int kBisections = 16;

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
};

bool SensorSky::Slice::continues(const Slice& other) const {
  return ranges == other.ranges && ranges <= 1 && low_edge.continues(other.low_edge) &&
         high_edge.continues(other.high_edge);
}

SensorSky::SensorSky(const RayVisibility& rays, const SkyTable* table, Vec3 position, Vec3 normal,
                     SampleRandom random)
    : rays_(rays), table_(table), normal_(normal), random_(random),
      tracer_(rays, position + rays.lift_m() * normal), start_(2.0 * kPi * random_.uniform()) {}

void SensorSky::refine() {
  const std::size_t old = slice_.size(), count = old == 0 ? kFirstSlices : 2 * old;
  const double pitch = 2.0 * kPi / static_cast<double>(count);
  const double checks_variance = square(2.0 * kPi / static_cast<double>(std::max<std::size_t>(
                                     old, 1))) * checks_.lux_squared;
  const bool all_well = old > 0 && checks_.lux_squared == 0.0 && checks_.view == 0.0;
  const int checks = checks_variance > 0.5 * variance_ ? kDenseChecks : 1;
  std::vector<Slice> refined(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (old > 0 && i % 2 == 0) {
      refined[i] = slice_[i / 2];
      continue;
    }
    const double azimuth =
        start_ + pitch * static_cast<double>(i) + kScatter * (random_.uniform() - 0.5);
    const bool checked = !all_well || (i / 2) % kRareCheck == 0;
    refined[i] = make_slice(azimuth, checked ? checks : 0, all_well ? kRareCheck : 1);
  }
  slice_ = std::move(refined);
  summarise();
}

SensorSky::Slice SensorSky::make_slice(double azimuth_rad, int checks, double weight) {
  Work work;
  work.along = normal_.x * std::sin(azimuth_rad) + normal_.y * std::cos(azimuth_rad);
  work.up = normal_.z;
  work.front = front_range(work.along, work.up);
  Slice slice;
  slice.ranges = 1;
  if (!(work.front.low < work.front.high)) return slice;
  if (table_ != nullptr) work.column = table_->column(azimuth_rad);
  work.visible = tracer_.trace(azimuth_rad, work.front.low, work.front.high);
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
  const double whole = work.measure(low, high), whole_view = work.view(low, high);
  if (!(whole > 0.0)) return;
  double lux = 0.0, view = 0.0;
  for (int k = 0; k < checks; ++k) {
    const double wanted = whole * (k + random_.uniform()) / checks;
    double a = low, b = high;
    for (int step = 0; step < kBisections; ++step) {
      const double middle = 0.5 * (a + b);
      (work.measure(low, middle) < wanted ? a : b) = middle;
    }
    const double altitude = 0.5 * (a + b);
    double claimed = 0.0;
    for (const auto& [range, transmittance] : piece_) {
      if (altitude >= range.low && altitude <= range.high) claimed = transmittance;
    }
    double truth = tracer_.check(altitude, claimed > 0.0) ? 1.0 : 0.0;
    if (truth > 0.0 && rays_.has_glass()) truth = tracer_.glass_transmission(altitude);
    const double missed = truth - claimed;
    if (missed == 0.0) continue;
    lux += missed * work.lux(low, high);
    const double density = work.measure(a, b) / whole;  // of the draw, over the last bracket
    view += missed * (density > 0.0 ? work.view(a, b) / density : whole_view);
  }
  lux *= weight / checks;
  checks_.lux += lux;
  checks_.view += view * weight / checks;
  checks_.lux_squared += square(lux);
}

double SensorSky::step_variance() const {
  const std::size_t count = slice_.size();
  const double pitch = 2.0 * kPi / static_cast<double>(count);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Slice &before = slice_[(i + count - 1) % count], &here = slice_[i],
                &after = slice_[(i + 1) % count];
    const double bend = here.lux - 0.5 * (before.lux + after.lux);
    // A kink of slope change c gives sum(bend^2) = (wc)^2 / 6 and a variance of w^4 c^2 / 720.
    const bool is_smooth = before.continues(here) && here.continues(after);
    if (!is_smooth) {
      sum += square(bend) * (1.0 / 6.0 + kScatter / (3.0 * pitch));
      continue;
    }
    const double rise = 0.5 * (after.lux - before.lux) / pitch;
    sum += square(bend) / 120.0 + square(rise * kScatter) / 12.0;
  }
  return sum;
}

void SensorSky::summarise() {
  const double pitch = 2.0 * kPi / static_cast<double>(slice_.size());
  double lux = checks_.lux, view = checks_.view;
  for (const Slice& slice : slice_) {
    lux += slice.lux;
    view += slice.view;
  }
  lux_ = std::max(0.0, pitch * lux);
  sky_view_ = std::clamp(pitch * view, 0.0, 1.0);
  variance_ = square(pitch) * (step_variance() + checks_.lux_squared);
}

}  // namespace tenku
