#include "illuminance/sensor_sky.h"

#include <algorithm>
#include <cmath>

namespace tenku {
namespace {

constexpr int kRareCheck = 4;  // of the later slices one in so many is checked while all goes well
constexpr int kDenseChecks = 4;  // rays a checked slice, where the checks dominate the error
constexpr double kGolden = 0.6180339887498949;
constexpr int kMostAgain = 3;           // times that all slices are traced again
constexpr double kSameAltitude = 1e-3;  // radians

// Where slices are added.
constexpr double kWorthFilling = 0.2;  // of the worst gap's error
constexpr double kLeastHole = 0.02;    // of a gap

constexpr double square(double x) { return x * x; }

}  // namespace

SensorSky::SensorSky(const RayVisibility& rays, const SkyTable* table, Vec3 position, Vec3 normal,
                     SampleRandom random, Effort effort)
    : sight_{rays, table, position + rays.lift_m() * normal, normal},
      random_(random),
      effort_(effort),
      tracer_(rays, sight_.origin, effort.least_part_rad),
      start_(2.0 * kPi * random_.uniform()),
      check_start_(random_.uniform()) {}

SensorSky::SensorSky(const RayVisibility& rays, const SkyTable* table, Vec3 position, Vec3 normal,
                     SampleRandom random)
    : SensorSky(rays, table, position, normal, random, Effort{}) {}

void SensorSky::refine(double enough) {
  if (is_filled_ || (is_outlined_ && has_sure_claims())) {
    fill_gaps();
  } else {
    const int known = tracer_.floating();
    double_evenly();
    if (tracer_.floating() > known && traced_again_ < kMostAgain) trace_again();
  }
  summarise(enough);
}

/// Checks have met things that float: the slices made before did not know them. What the checks
/// found is then part of the slices, and new slices must be checked in the place of all. A slice
/// that claims more sky than before has lost what it knew: what is claimed is never too little.
void SensorSky::trace_again() {
  for (Entry& entry : entry_) {
    SkySlice again = make_slice(entry.slice.azimuth, 0, 0.0);
    if (again.light.view < entry.slice.light.view) entry.slice = again;
  }
  checks_ = {};
  unchecked_ = true;
  ++traced_again_;
}

void SensorSky::double_evenly() {
  const std::size_t old = entry_.size();
  const std::size_t count = old == 0 ? static_cast<std::size_t>(effort_.first_slices) : 2 * old;
  const double pitch = 2.0 * kPi / static_cast<double>(count);
  // The first slices and those between them are all checked: fewer would miss what floats.
  const bool is_rare = old > static_cast<std::size_t>(effort_.first_slices) && !unchecked_ &&
                       checks_.lux_squared == 0.0 && checks_.view == 0.0;
  const int checks = checks_.lux_squared > 0.5 * variance_ ? kDenseChecks : 1;
  // All slices stand for half as much azimuth as before, and so do their checks.
  checks_ = {0.5 * checks_.lux, 0.5 * checks_.view, 0.25 * checks_.lux_squared};
  const double stands_for = pitch * (unchecked_ ? 2.0 : 1.0) * (is_rare ? kRareCheck : 1);
  std::vector<Entry> refined(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (old > 0 && i % 2 == 0) {
      refined[i].slice = entry_[i / 2].slice;
      continue;
    }
    const double azimuth =
        start_ + pitch * static_cast<double>(i) + kScatter * (random_.uniform() - 0.5);
    const bool checked = effort_.checked && (!is_rare || (i / 2) % kRareCheck == 0);
    const bool is_first = old == 0;
    const SliceHints left = is_first ? SliceHints{} : at(i / 2).hints;
    const SliceHints right = is_first ? SliceHints{} : at(i / 2 + 1).hints;
    refined[i].slice = make_slice(azimuth, checked ? checks : 0, stands_for, left, right);
  }
  entry_ = std::move(refined);
  unchecked_ = false;
}

void SensorSky::fill_gaps() {
  const std::size_t count = entry_.size();
  std::vector<double> variance(count);
  for (std::size_t i = 0; i < count; ++i) variance[i] = gap_variance(i);
  const double worst = *std::max_element(variance.begin(), variance.end());
  std::vector<Entry> refined;
  refined.reserve(count + count / 2);
  is_filled_ = true;
  for (std::size_t i = 0; i < count; ++i) {
    refined.push_back(entry_[i]);
    // Where no gap is worse than another (all is known), each is filled.
    if (worst > 0.0 && variance[i] <= square(kWorthFilling) * worst) continue;
    const double width = width_after(i), random = 0.3 + 0.4 * random_.uniform();
    const GapLight& gap = entry_[i].gap;
    const bool has_hole = gap.hole_width > kLeastHole * width && !gap.is_blind;
    const double offset = has_hole ? gap.hole_begin + random * gap.hole_width : random * width;
    refined.emplace_back();
    refined.back().slice = make_slice(at(i).azimuth + offset, 0, 0.0, at(i).hints, at(i + 1).hints);
  }
  entry_ = std::move(refined);
}

/// Whether the checks have nothing more to tell: slices that fill gaps are not checked.
bool SensorSky::has_sure_claims() const {
  constexpr double kSure = 1e-4;  // of the value
  return !unchecked_ && checks_.lux_squared <= square(kSure * lux_) &&
         (sight_.table != nullptr || checks_.view == 0.0);
}

double SensorSky::width_after(std::size_t i) const {
  const double width = at(i + 1).azimuth - at(i).azimuth;
  return i + 1 < entry_.size() ? width : width + 2.0 * kPi;
}

SkySlice SensorSky::make_slice(double azimuth_rad, int checks, double weight, SliceHints before,
                               SliceHints after) {
  SkySlice slice;
  slice.azimuth = azimuth_rad;
  slice.along = {std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0};
  const SliceLight light(sight_.table, sight_.normal, azimuth_rad, slice.along);
  const Altitude low = light.low(), high = light.high();
  slice.is_behind = light.is_behind();
  if (slice.is_behind) return slice;
  const VisibleSlice visible = tracer_.trace(slice.along, low, high, before, after);
  slice.hints = visible.hints;
  slice.is_open = visible.count > 0;
  piece_.clear();
  for (int i = 0; i < visible.count; ++i) {
    const AltitudeRange range = visible.range[static_cast<std::size_t>(i)];
    pane_rays_ += static_cast<std::uint64_t>(
        append_pieces(sight_, slice.along, range.low, range.high, piece_));
  }
  slice.light = light_through(light, piece_);
  bound(slice, visible, low.radians, high.radians);
  if (checks > 0) check(light, checks, weight);
  return slice;
}

/// Takes the outlines over, if they are what bounds the visible range.
void SensorSky::bound(SkySlice& slice, const VisibleSlice& visible, double low, double high) const {
  if (visible.count != 1) return;
  const auto segment = [&](OutlineEdge edge) {
    if (edge.a == MeshAdjacency::kNone) return OutlineSegment();
    const auto& vertex = sight_.rays.soup().vertices;
    return OutlineSegment(vertex[edge.a] - sight_.origin, vertex[edge.b] - sight_.origin);
  };
  const auto stands_at = [&](const OutlineSegment& edge, double otherwise, const Altitude& found) {
    if (!edge.exists()) return std::abs(otherwise - found.radians) < kSameAltitude;
    const double slope = edge.slope(slice.along);
    return square(slope * found.cosine - found.sine) <
           square(kSameAltitude) * (1.0 + slope * slope);
  };
  slice.low_edge = visible.low_edge;
  slice.high_edge = visible.high_edge;
  slice.low = segment(visible.low_edge);
  slice.high = segment(visible.high_edge);
  slice.is_outlined = stands_at(slice.low, low, visible.range[0].low) &&
                      stands_at(slice.high, high, visible.range[0].high);
}

void SensorSky::check(const SliceLight& light, int checks, double weight) {
  const auto [low, high] = light.front();
  const double whole = light.measure(low, high);
  if (!(whole > 0.0)) return;
  LuxAndView sum;
  for (int k = 0; k < checks; ++k) {
    // A row of the table in proportion to its light, then any altitude in it alike.
    // Golden steps from a random start: with the azimuths they cover the sky evenly, so that what
    // floats is met by one of few checks if it is as large as what a check stands for.
    const double turns = check_start_ + kGolden * checked_++;
    const double wanted = whole * (k + turns - std::floor(turns)) / checks;
    const auto [a, b] = light.row_reaching(wanted, low, high);
    const double altitude = a + (b - a) * random_.uniform();
    double claimed = 0.0;
    for (const SeenPiece& p : piece_) {
      if (altitude >= p.low.radians && altitude <= p.high.radians) claimed = p.transmittance;
    }
    const bool visible = tracer_.check(altitude, claimed > 0.0);
    if (visible == (claimed > 0.0)) continue;
    const double chance = light.measure(a, b) / whole;
    if (!(chance > 0.0)) continue;
    const double missed = visible ? tracer_.glass_transmission(altitude) : -claimed;
    sum = sum + (missed / chance) * light.both(Altitude::of(a), Altitude::of(b));
  }
  sum = (weight / checks) * sum;
  checks_.lux += sum.lux;
  checks_.view += sum.view;
  checks_.lux_squared += square(sum.lux);
}

void SensorSky::summarise(double enough) {
  seeing_ = static_cast<int>(
      std::count_if(entry_.begin(), entry_.end(), [](const Entry& e) { return e.slice.is_open; }));
  find_unmet_parts();
  Sum sum;
  if (!is_outlined_) sum = even_sum();
  const bool is_enough = !is_outlined_ && sum.variance + checks_.lux_squared <= enough;
  if (effort_.outlined && !is_enough && seeing_ >= kSeeing && slices() >= kFewest) {
    learn(is_outlined_ ? lux_ : sum.light.lux);
    is_outlined_ = is_outlined_ || outlines_tell();
  }
  if (is_outlined_) sum = outlined_sum();
  lux_ = sum.light.lux + checks_.lux;
  sky_view_ = std::clamp(sum.light.view + checks_.view, 0.0, 1.0);
  variance_ = sum.variance + checks_.lux_squared;
}

}  // namespace tenku