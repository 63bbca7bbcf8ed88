#include "illuminance/sky_interpolation.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "core/random.h"
#include "illuminance/pilots.h"
#include "illuminance/sensor_cells.h"
#include "illuminance/sensor_sun.h"

namespace tenku {
namespace {

// Rounds.
constexpr double kMostInCell = 64.0, kLeastInCell = 3.0;  // sensors
constexpr double kFiner = 2.0;                            // a round
constexpr std::size_t kGrain = 64;                        // sensors a task
constexpr std::size_t kPilots = 1000, kPilotShare = 40;   // one in so many sensors, at most

// Fits.
constexpr std::size_t kLeastPoints = 5;
constexpr double kUnknown = 0.002;  // of a fit: what its points may all have missed
constexpr double kPoint = 0.5;      // of the mean interval of its points

// What stands so near that light changes faster than those around can tell: after G. Ward,
// F. Rubinstein and R. Clear, "A ray tracing solution for diffuse interreflection", SIGGRAPH 1988.
constexpr int kProbes = 8;               // ways around, at
constexpr double kProbeSlope = 0.57735;  // 30 degrees up
constexpr double kTooNear = 1.0;         // of the way to the nearest point

// Trust.
constexpr std::size_t kFewestPilots = 60;
constexpr double kPartOfTolerance = 0.5;  // as ErrorBudget has it
constexpr double kFinerPilots = 4.0;      // times the tolerance of what they are to judge
constexpr double kFinestPilots_pct = 0.1;

/// The value at a place of a plane through points around it.
struct Fit {
  double lux = 0.0, view = 0.0;
  double scale_lux = 0.0;
};

/// Sums for a weighted plane a + b u + c v.
class PlaneFit {
 public:
  void add(double u, double v, double weight, double lux, double view, double error_lux) {
    const std::array<double, 3> row{1.0, u, v};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) normal_[i][j] += weight * row[i] * row[j];
      lux_[i] += weight * row[i] * lux;
      view_[i] += weight * row[i] * view;
    }
    squares_ += weight * lux * lux;
    error_ += weight * error_lux;
    ++count_;
  }

  /// The value at u = v = 0; none where the points are few or lie in a line.
  std::optional<Fit> at_origin() const {
    constexpr double kInLine = 1e-3;
    if (count_ < kLeastPoints) return std::nullopt;
    const double weight = normal_[0][0];
    Rows inverse;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) inverse[i][j] = cofactor(i, j);
    }
    const double determinant = sum_of_products(normal_[0], inverse[0]);
    if (!(determinant > kInLine * weight * weight * weight)) return std::nullopt;
    double explained = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      explained += lux_[i] * sum_of_products(inverse[i], lux_) / determinant;
    }
    Fit fit;
    fit.lux = std::max(0.0, sum_of_products(inverse[0], lux_) / determinant);
    fit.view = std::clamp(sum_of_products(inverse[0], view_) / determinant, 0.0, 1.0);
    const auto n = static_cast<double>(count_);
    const double off = std::max(0.0, squares_ - explained) / weight * n / (n - 3.0);
    // At the rim of its points a plane is known worse.
    const double leverage = inverse[0][0] / determinant * weight / n;
    fit.scale_lux =
        std::hypot(std::sqrt(off * (1.0 + leverage)), kPoint * error_ / weight, kUnknown * fit.lux);
    return fit;
  }

 private:
  using Rows = std::array<std::array<double, 3>, 3>;

  static double sum_of_products(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  double cofactor(std::size_t i, std::size_t j) const {
    const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    return normal_[i1][j1] * normal_[i2][j2] - normal_[i1][j2] * normal_[i2][j1];
  }

  Rows normal_{};
  std::array<double, 3> lux_{}, view_{};
  double squares_ = 0.0, error_ = 0.0;
  std::size_t count_ = 0;
};

std::vector<std::uint64_t> planes_of(const Sensors& sensors) {
  std::vector<std::uint64_t> planes;
  planes.reserve(sensors.size());
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    planes.push_back(plane_of(sensors.normal[s], sensors.position[s]));
  }
  return planes;
}

class SparseLight {
 public:
  SparseLight(const Sensors& sensors, const RayVisibility& rays, const DaylightSource& source,
              const IlluminanceOptions& options, Progress& progress)
      : sensors_(sensors),
        rays_(rays),
        source_(source),
        options_(options),
        progress_(progress),
        budget_(options.tolerance_pct, options.floor_share * source.unobstructed_lux()),
        planes_(planes_of(sensors)),
        order_(shuffled(sensors.size())),
        state_(sensors.size(), State::Open) {
    result_.values = SensorIlluminance(sensors.size());
    result_.is_missed.resize(sensors.size());
  }

  void light() {
    double cell_m = cell_with(kMostInCell, sensors_, planes_);
    while (sensors_in_cell(sensors_, planes_, cell_m) >= kLeastInCell) {
      settle_round(cell_m);
      cell_m /= kFiner;
    }
    calculate(open());
  }

  std::size_t interpolated() const {
    return static_cast<std::size_t>(std::count(state_.begin(), state_.end(), State::Interpolated));
  }

  IlluminanceResult take() {
    result_.rays += rays_sent_;
    tell_missed(result_);
    if (source_.unobstructed_lux() > 0.0) {
      find_dark_sensors(sensors_, result_.values, result_.findings);
    }
    return std::move(result_);
  }

 private:
  enum class State : std::uint8_t { Open, Calculated, Interpolated };

  std::vector<std::uint32_t> open() const {
    std::vector<std::uint32_t> chosen;
    for (std::uint32_t s = 0; s < sensors_.size(); ++s) {
      if (state_[s] == State::Open) chosen.push_back(s);
    }
    return chosen;
  }

  void calculate(const std::vector<std::uint32_t>& chosen, double finer = 1.0) {
    if (chosen.empty()) return;
    IlluminanceOptions options = options_;
    options.tolerance_pct =
        std::max(std::min(options.tolerance_pct, kFinestPilots_pct), options.tolerance_pct / finer);
    Progress quiet;
    const IlluminanceResult part =
        illuminate(sensors_of(sensors_, chosen), rays_, source_, options, quiet);
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      const std::uint32_t s = chosen[k];
      state_[s] = State::Calculated;
      result_.values.sun_lux[s] = part.values.sun_lux[k];
      result_.values.sky_lux[s] = part.values.sky_lux[k];
      result_.values.sky_view[s] = part.values.sky_view[k];
      result_.values.error_lux[s] = part.values.error_lux[k];
      result_.is_missed[s] =
          part.values.error_lux[k] > budget_.allowed_lux(part.values.total_lux(k));
    }
    result_.rays += part.rays;
    progress_.advance(chosen.size());
  }

  void settle_round(double cell_m) {
    SensorCells cells(places_in_cells(sensors_, cell_m), planes_, 1);
    for (std::uint32_t s = 0; s < sensors_.size(); ++s) {
      if (state_[s] == State::Calculated) cells.add(s, s);
    }
    std::vector<std::uint32_t> chosen;
    for (const std::uint32_t s : order_) {
      if (state_[s] != State::Open || !cells.beside(s).empty()) continue;
      cells.add(s, s);
      chosen.push_back(s);
    }
    calculate(chosen);
    const std::vector<std::uint32_t> pilots = draw_pilots();
    calculate(pilots, kFinerPilots);
    const Trust trust = trust_of(cells, pilots);
    const std::vector<std::uint32_t> waiting = open();
    parallel_for(waiting.size(), kGrain, [&](IndexRange range) {
      progress_.stop_if_cancelled();
      std::size_t settled = 0;
      for (std::size_t k = range.begin; k < range.end; ++k) {
        settled += settle(cells, waiting[k], trust) ? 1 : 0;
      }
      progress_.advance(settled);
    });
  }

  std::vector<std::uint32_t> draw_pilots() const {
    const std::size_t most = std::min(kPilots, sensors_.size() / kPilotShare);
    std::vector<std::uint32_t> pilots;
    for (const std::uint32_t s : order_) {
      if (pilots.size() == most) break;
      if (state_[s] == State::Open) pilots.push_back(s);
    }
    return pilots;
  }

  /// What of the fits is good enough: those with a scale of at most so much of what is allowed,
  /// and the interval by scale of these.
  struct Trust {
    double most_scale = 0.0, interval_per_scale = 0.0;
  };

  Trust trust_of(const SensorCells& cells, const std::vector<std::uint32_t>& pilots) const {
    struct Tried {
      double scale, ratio;  // of what is allowed; of the miss by the scale
    };
    std::vector<Tried> tried;
    for (const std::uint32_t s : pilots) {
      const std::optional<Fit> fit = fit_at(cells, s);
      if (!fit || !(fit->scale_lux > 0.0)) continue;
      const double miss = std::abs(fit->lux - result_.values.sky_lux[s]);
      tried.push_back({fit->scale_lux / budget_.allowed_lux(fit->lux), miss / fit->scale_lux});
    }
    std::sort(tried.begin(), tried.end(),
              [](const Tried& a, const Tried& b) { return a.scale < b.scale; });
    Trust trust;
    std::vector<double> ratio;
    for (const Tried& t : tried) {
      ratio.insert(std::upper_bound(ratio.begin(), ratio.end(), t.ratio), t.ratio);
      if (ratio.size() < kFewestPilots) continue;
      const double factor = conformal_quantile(ratio);
      if (factor * t.scale <= kPartOfTolerance) trust = {t.scale, factor};
    }
    return trust;
  }

  std::optional<Fit> fit_at(const SensorCells& cells, std::uint32_t s) const {
    const TangentFrame frame = tangent_frame(sensors_.normal[s]);
    PlaneFit plane;
    std::uint32_t nearest = s;
    double shortest = std::numeric_limits<double>::infinity();
    cells.around(s, [&](std::uint32_t other) {
      if (other == s || !see_each_other(sensors_, s, other, rays_)) return;
      const Vec3 way = cells.place(other) - cells.place(s);
      if (dot(way, way) < shortest) nearest = other, shortest = dot(way, way);
      plane.add(dot(way, frame.tangent), dot(way, frame.bitangent), std::exp(-dot(way, way)),
                result_.values.sky_lux[other], result_.values.sky_view[other],
                result_.values.error_lux[other]);
    });
    // Under a roof that the others are not under.
    if (is_covered(s) != is_covered(nearest)) return std::nullopt;
    const double nearest_m = length(sensors_.position[nearest] - sensors_.position[s]);
    if (is_beside_something(s, kTooNear * nearest_m)) return std::nullopt;
    return plane.at_origin();
  }

  bool is_beside_something(std::uint32_t s, double within_m) const {
    const Vec3 normal = sensors_.normal[s];
    const TangentFrame frame = tangent_frame(normal);
    const Vec3 origin = sensors_.position[s] + rays_.lift_m() * normal;
    for (int k = 0; k < kProbes; ++k) {
      const double turn = 2.0 * kPi * k / kProbes;
      const Vec3 level = std::cos(turn) * frame.tangent + std::sin(turn) * frame.bitangent;
      const auto hit = rays_.first_hit(origin, normalized(level + kProbeSlope * normal));
      if (hit && hit->distance_m < within_m) return true;
    }
    return false;
  }

  bool is_covered(std::uint32_t s) const {
    const Vec3 normal = sensors_.normal[s];
    return rays_.is_occluded(sensors_.position[s] + rays_.lift_m() * normal, normal);
  }

  bool settle(const SensorCells& cells, std::uint32_t s, const Trust& trust) {
    const std::optional<Fit> fit = fit_at(cells, s);
    if (!fit || fit->scale_lux > trust.most_scale * budget_.allowed_lux(fit->lux)) return false;
    const double interval = trust.interval_per_scale * fit->scale_lux;
    SensorSun sun(rays_, source_.sun, sensors_.position[s], sensors_.normal[s],
                  mix_bits(mix_bits(options_.seed) + s));
    sun.refine();
    while (sun.variance() > budget_.allowed_variance(fit->lux + sun.lux()) &&
           sun.rays_sent() < static_cast<std::uint64_t>(options_.most_paths)) {
      sun.refine();
    }
    state_[s] = State::Interpolated;
    result_.values.sun_lux[s] = sun.lux();
    result_.values.sky_lux[s] = fit->lux;
    result_.values.sky_view[s] = fit->view;
    result_.values.error_lux[s] = std::hypot(interval, interval_lux(sun.variance(), 0.0));
    rays_sent_ += sun.rays_sent();
    return true;
  }

  const Sensors& sensors_;
  const RayVisibility& rays_;
  const DaylightSource& source_;
  const IlluminanceOptions& options_;
  Progress& progress_;
  ErrorBudget budget_;
  std::vector<std::uint64_t> planes_;
  std::vector<std::uint32_t> order_;
  std::vector<State> state_;
  std::atomic<std::uint64_t> rays_sent_{0};
  IlluminanceResult result_;
};

}  // namespace

IlluminanceResult illuminate_sparsely(const Sensors& sensors, const RayVisibility& rays,
                                      const DaylightSource& source,
                                      const IlluminanceOptions& options, Progress& progress,
                                      std::size_t* interpolated) {
  SparseLight light(sensors, rays, source, options, progress);
  progress.begin("illuminance", sensors.size());
  light.light();
  IlluminanceResult result = light.take();
  if (interpolated != nullptr) *interpolated = light.interpolated();
  progress.end(std::to_string(sensors.size()) + " sensors, " +
               std::to_string(light.interpolated()) + " of them from those around, " +
               std::to_string(result.rays) + " rays");
  return result;
}

}  // namespace tenku
