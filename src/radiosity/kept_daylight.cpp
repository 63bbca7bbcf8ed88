#include "radiosity/kept_daylight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "illuminance/error_budget.h"
#include "illuminance/outline_gap.h"
#include "illuminance/sensor_cells.h"
#include "illuminance/sensor_sun.h"
#include "sky_models/cie_general_sky.h"
#include "visibility/slice_tracer.h"

namespace tenku {
namespace {

constexpr std::size_t kLightGrain = 256;          // the same where a sensor costs little
constexpr std::size_t kGrain = 16;                // sensors a task
constexpr int kFirst = 16, kMost = 4096;          // slices in a turn
constexpr int kMostInDark = 256;                  // where none has seen the sky
constexpr int kFine = 64;                         // in a turn, where the sky is seen, at least
constexpr int kEnough = 32;                       // that see the sky
constexpr double kOtherwise = 0.2;                // of what is missed, as measured in a room
constexpr int kFiner = 4;                         // times as many slices, where trials ask for it
constexpr std::uint8_t kFinest = 2;               // times that
constexpr int kTrials = 6;                        // clear skies, by which that is found
constexpr double kTrialSun_deg = 35.0;            // altitude
constexpr std::uint64_t kStream = 0x6b657074ULL;  // of the random start of slices

/// The slices of one sensor, more and more where it sees the sky.
class SeenSlices {
 public:
  struct Slice {
    double azimuth;
    double toward;  ///< component of the normal toward it
    std::vector<SeenPiece> piece;
  };

  /// @param finer  by which factor more slices than usual
  SeenSlices(const RayVisibility& rays, Vec3 position, Vec3 normal, double start, int finer)
      : sight_{rays, nullptr, position + rays.lift_m() * normal, normal},
        tracer_(rays, sight_.origin) {
    for (int k = 0; k < kFirst; ++k) add(start + 2.0 * kPi * k / kFirst, slice_);
    int turn = kFirst;
    while (turn < (seeing() > 0 ? finer * kMost : kMostInDark) &&
           (turn < finer * kFine || seeing() < finer * kEnough)) {
      refine();
      turn *= 2;
    }
  }

  const std::vector<Slice>& slices() const { return slice_; }
  /// Half of the gaps on both sides.
  double width(std::size_t i) const {
    const std::size_t count = slice_.size();
    const double left = i > 0 ? slice_[i - 1].azimuth : slice_[count - 1].azimuth - 2.0 * kPi;
    const double right = i + 1 < count ? slice_[i + 1].azimuth : slice_[0].azimuth + 2.0 * kPi;
    return 0.5 * (right - left);
  }

 private:
  int seeing() const {
    return static_cast<int>(std::count_if(slice_.begin(), slice_.end(),
                                          [](const Slice& s) { return !s.piece.empty(); }));
  }

  /// One in the middle of each gap beside a slice that sees the sky; of each where none does.
  void refine() {
    const bool is_dark = seeing() == 0;
    std::vector<Slice> finer;
    for (std::size_t i = 0; i < slice_.size(); ++i) {
      const Slice& next = slice_[(i + 1) % slice_.size()];
      const double gap =
          next.azimuth - slice_[i].azimuth + (i + 1 < slice_.size() ? 0.0 : 2.0 * kPi);
      const bool is_wanted = is_dark || !slice_[i].piece.empty() || !next.piece.empty();
      finer.push_back(slice_[i]);
      if (is_wanted) add(slice_[i].azimuth + 0.5 * gap, finer);
    }
    slice_ = std::move(finer);
  }

  void add(double azimuth, std::vector<Slice>& to) {
    const Vec3 along{std::sin(azimuth), std::cos(azimuth), 0.0};
    Slice slice{azimuth, dot(sight_.normal, along), {}};
    const auto [low, high] = front_range(slice.toward, sight_.normal.z);
    if (low < high) {
      const VisibleSlice visible = tracer_.trace(along, Altitude::of(low), Altitude::of(high));
      for (int k = 0; k < visible.count; ++k) {
        const AltitudeRange range = visible.range[static_cast<std::size_t>(k)];
        append_pieces(sight_, along, range.low, range.high, slice.piece);
      }
    }
    to.push_back(std::move(slice));
  }

  SensorSight sight_;
  SliceTracer tracer_;
  std::vector<Slice> slice_;
};

/// The variance of which these are draws, squares of normal numbers: by the median, which a few
/// that are much greater do not move.
double usual_variance(std::vector<double> squares) {
  constexpr double kMedian = 0.4549;  // of the chi-squared distribution of one degree of freedom
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return *middle / kMedian;
}

bool is_kept(const DaylightSource& source) {
  return source.sky != nullptr && source.model != nullptr && source.elements == nullptr &&
         source.sky->horizontal_lux() > 0.0;
}

}  // namespace

IlluminanceResult KeptDaylight::light(const Sensors& sensors, const DaylightMethod& daylight,
                                      Progress& progress) {
  if (weights_ && is_kept(daylight.source)) return taken_over(sensors, daylight, progress);
  IlluminanceResult found = illuminate(sensors, daylight.engines, daylight.source, daylight.options,
                                       daylight.method, progress);
  found_anew_ = sensors.size();
  if (keeps_ && !weights_ && is_kept(daylight.source)) {
    keep(sensors, daylight, found, progress);
  }
  return found;
}

void KeptDaylight::keep(const Sensors& sensors, const DaylightMethod& daylight,
                        IlluminanceResult first, Progress& progress) {
  first_ = std::move(first.values);
  first_horizontal_lux_ = daylight.source.sky->horizontal_lux();
  const std::vector<std::uint8_t> everywhere(SkyGrid::kNodes, 1);
  first_luminance_ = SkyGrid::luminances(*daylight.source.model, everywhere);
  weights_.emplace(sensors.size());
  seen_.resize(sensors.size());
  std::unordered_map<std::uint64_t, std::uint32_t> plane;
  std::vector<std::uint32_t> that_see;
  for (std::uint32_t i = 0; i < sensors.size(); ++i) {
    const auto next = static_cast<std::uint32_t>(plane.size());
    const std::uint64_t key = plane_of(sensors.normal[i], sensors.position[i]);
    seen_[i].plane = plane.emplace(key, next).first->second;
    if (first_.sky_lux[i] > 0.0) that_see.push_back(i);
  }
  planes_ = static_cast<std::uint32_t>(plane.size());
  keep_looks(sensors, that_see, daylight, progress);
  for (std::uint8_t k = 0; k < kFinest; ++k) {
    const std::vector<std::uint32_t> rough = rough_in_trials(daylight.options);
    for (const std::uint32_t i : rough) ++seen_[i].fineness;
    keep_looks(sensors, rough, daylight, progress);
  }
}

/// Sensors that would be found anew under clear skies.
std::vector<std::uint32_t> KeptDaylight::rough_in_trials(const IlluminanceOptions& options) const {
  std::vector<std::uint8_t> is_rough(seen_.size());
  for (int k = 0; k < kTrials; ++k) {
    const Vec3 sun =
        direction_from(Angle::degrees(360.0 / kTrials * k), Angle::degrees(kTrialSun_deg));
    const auto luminance =
        SkyGrid::luminances(CieGeneralSky(12, sun, Luminance(1.0)), weights_->is_used());
    const ErrorBudget budget(options.tolerance_pct, 0.0);
    const std::vector<Times> all = times_of_all(luminance);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!all[i].is_known) continue;
      const double lux = all[i].mean * first_.sky_lux[i];
      const double error = std::hypot(all[i].mean * first_.error_lux[i],
                                      interval_lux(all[i].variance * lux * lux, 0.0));
      is_rough[i] |= error > budget.allowed_lux(lux);
    }
  }
  std::vector<std::uint32_t> rough;
  for (std::uint32_t i = 0; i < is_rough.size(); ++i) {
    if (is_rough[i] != 0) rough.push_back(i);
  }
  return rough;
}

void KeptDaylight::keep_looks(const Sensors& sensors, std::span<const std::uint32_t> which,
                              const DaylightMethod& daylight, Progress& progress) {
  progress.begin("what sensors see of the sky", which.size());
  std::vector<Looked> looked(which.size());
  parallel_for(which.size(), kGrain, [&](IndexRange range) {
    progress.stop_if_cancelled();
    for (std::size_t k = range.begin; k < range.end; ++k) {
      looked[k] = look(sensors, which[k], daylight);
    }
    progress.advance(range.end - range.begin);
  });
  for (std::size_t k = 0; k < which.size(); ++k) {
    weights_->set(which[k], looked[k].row);
    Seen& seen = seen_[which[k]];
    seen.first_lux = weights_->lux(which[k], first_luminance_);
    seen.is_enough = looked[k].is_enough && seen.first_lux[0] > 0.0 && seen.first_lux[1] > 0.0;
  }
  progress.end(std::to_string(weights_->size()) + " weights");
}

KeptDaylight::Looked KeptDaylight::look(const Sensors& sensors, std::size_t i,
                                        const DaylightMethod& daylight) const {
  const Vec3 normal = sensors.normal[i];
  SampleRandom random(daylight.options.seed ^ kStream, i, seen_[i].fineness);
  const double start = 2.0 * kPi * random.uniform();
  int finer = 1;
  for (std::uint8_t k = 0; k < seen_[i].fineness; ++k) finer *= kFiner;
  const SeenSlices seen(daylight.engines.rays(), sensors.position[i], normal, start, finer);
  Looked looked;
  int number = 0;
  for (std::size_t k = 0; k < seen.slices().size(); ++k) {
    const auto& slice = seen.slices()[k];
    if (slice.piece.empty()) continue;
    // Two halves of the slices, a b b a a b b a: a slope over what is seen is in both alike.
    const auto half = static_cast<std::size_t>((number + 1) / 2 % 2);
    for (const SeenPiece& p : slice.piece) {
      add_range({slice.azimuth, slice.toward, normal.z, seen.width(k) * p.transmittance,
                 p.low.radians, p.high.radians},
                random, half, looked.row);
    }
    ++number;
  }
  looked.is_enough = number >= kFewestSeeing;
  return looked;
}

KeptDaylight::Times KeptDaylight::times(std::size_t sensor,
                                        std::span<const float> luminance) const {
  const Seen& seen = seen_[sensor];
  if (!seen.is_enough) return {};
  const auto& first = seen.first_lux;
  const auto now = weights_->lux(sensor, luminance);
  Times times;
  times.mean = (now[0] + now[1]) / (first[0] + first[1]);
  times.is_known = times.mean > 0.0;
  if (!times.is_known) return {};
  const double halves = 0.5 * (now[0] / first[0] - now[1] / first[1]) / times.mean;
  // What the slices miss of the first light, they miss of another one in nearly the same way.
  const double missed = kOtherwise * ((first[0] + first[1]) / first_.sky_lux[sensor] - 1.0);
  times.variance = halves * halves + missed * missed;
  return times;
}

/// One difference tells little of its own size: those of a plane tell the rest.
std::vector<KeptDaylight::Times> KeptDaylight::times_of_all(
    std::span<const float> luminance) const {
  std::vector<Times> all(seen_.size());
  parallel_for(seen_.size(), kLightGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) all[i] = times(i, luminance);
  });
  std::vector<std::vector<double>> draws(planes_);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].is_known) draws[seen_[i].plane].push_back(all[i].variance);
  }
  std::vector<double> usual(planes_);
  for (std::size_t p = 0; p < planes_; ++p) {
    if (!draws[p].empty()) usual[p] = usual_variance(std::move(draws[p]));
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].is_known) all[i].variance = 0.5 * (usual[seen_[i].plane] + all[i].variance);
  }
  return all;
}

IlluminanceResult KeptDaylight::taken_over(const Sensors& sensors, const DaylightMethod& daylight,
                                           Progress& progress) {
  expects(seen_.size() == sensors.size(), "the sensors are those of the first sky");
  const DaylightSource& source = daylight.source;
  const RayVisibility& rays = daylight.engines.rays();
  const std::vector<Times> all =
      times_of_all(SkyGrid::luminances(*source.model, weights_->is_used()));
  const double of_horizon = source.sky->horizontal_lux() / first_horizontal_lux_;
  const ErrorBudget budget(daylight.options.tolerance_pct,
                           daylight.options.floor_share * source.unobstructed_lux());
  IlluminanceResult result;
  result.values = SensorIlluminance(sensors.size());
  result.is_missed.resize(sensors.size());
  std::vector<std::uint64_t> sent(sensors.size());
  progress.begin("daylight taken over", sensors.size());
  parallel_for(sensors.size(), kLightGrain, [&](IndexRange range) {
    progress.stop_if_cancelled();
    for (std::size_t i = range.begin; i < range.end; ++i) {
      // Of what sees nearly nothing, hardly anything is known: all of it may be wrong.
      const double times = all[i].is_known ? all[i].mean : of_horizon;
      const double variance = all[i].is_known ? all[i].variance : 1.0;
      const double sky_lux = times * first_.sky_lux[i];
      SensorSun sun(rays, source.sun, sensors.position[i], sensors.normal[i],
                    mix_bits(mix_bits(daylight.options.seed) + i));
      do {
        sun.refine();
      } while (sun.variance() > budget.allowed_variance(sky_lux + sun.lux()) &&
               sun.rays_sent() < static_cast<std::uint64_t>(daylight.options.most_paths));
      result.values.sun_lux[i] = sun.lux();
      result.values.sky_lux[i] = sky_lux;
      result.values.sky_view[i] = first_.sky_view[i];
      result.values.error_lux[i] =
          std::hypot(times * first_.error_lux[i],
                     interval_lux(variance * sky_lux * sky_lux + sun.variance(), 0.0));
      result.is_missed[i] =
          result.values.error_lux[i] > budget.allowed_lux(result.values.total_lux(i));
      sent[i] = sun.rays_sent();
    }
  });
  for (const std::uint64_t s : sent) result.rays += s;
  progress.end(std::to_string(sensors.size()) + " sensors");
  find_anew(sensors, daylight, progress, result);
  tell_missed(result);
  if (source.unobstructed_lux() > 0.0) find_dark_sensors(sensors, result.values, result.findings);
  return result;
}

void KeptDaylight::find_anew(const Sensors& sensors, const DaylightMethod& daylight,
                             Progress& progress, IlluminanceResult& result) {
  std::vector<std::uint32_t> missed;
  for (std::uint32_t i = 0; i < sensors.size(); ++i) {
    if (result.is_missed[i] != 0) missed.push_back(i);
  }
  found_anew_ = missed.size();
  if (missed.empty()) return;
  const IlluminanceResult part =
      illuminate(sensors_of(sensors, missed), daylight.engines, daylight.source, daylight.options,
                 daylight.method, progress);
  take_direct(part, missed, result);
}

}  // namespace tenku
