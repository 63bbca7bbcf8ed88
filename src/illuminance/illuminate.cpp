#include "illuminance/illuminate.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "illuminance/expected_time.h"
#include "illuminance/lamp_sampler.h"
#include "illuminance/reflected_light.h"
#include "illuminance/sensor_sky.h"
#include "illuminance/sensor_sun.h"
#include "illuminance/sky_cache.h"

namespace tenku {
namespace {

constexpr std::size_t kGrain = 16;     // sensors a task
constexpr double kSureOfDark = 512.0;  // slices times tolerance after which no sky is believed
// Standard errors that a value must be clear of a threshold by to stop early. Effort doubles up to
// eight times, each a chance to err: 0.05 / 8 on both sides (Bonferroni), so that all looks
// together err once in twenty.
constexpr double kErrorsToStop = 2.74;
constexpr int kMostSharedPaths = 2048;  // more would know one place better than those around it
constexpr double kDark_lux = 0.01;      // a moonless night, and what is left of rounding
constexpr double kBlended = 4.0;        // errors of blended representatives in one of their mean

void check_options(const IlluminanceOptions& options) {
  if (!(options.tolerance_pct > 0.0 && options.tolerance_pct <= 100.0)) {
    throw InputError("tolerance " + std::to_string(options.tolerance_pct) +
                     " is not in (0, 100] percent");
  }
  if (options.bounces < 0 || options.bounces > 100) {
    throw InputError("bounces " + std::to_string(options.bounces) + " is not in 0..100");
  }
}

/// Of the total or the skylight, in lux; below zero: nothing to decide.
double threshold_lux(const IlluminanceOptions& options, const DaylightSource& source) {
  if (!options.decide) return -1.0;
  const double sky_lux = source.sky ? source.sky->horizontal_lux() : 0.0;
  if (options.decide->of == DecisionThreshold::Of::Skylight && !(sky_lux > 0.0)) {
    throw InputError("a share of the sky cannot be decided on without a sky: give --sky");
  }
  return options.decide->lux(sky_lux);
}

bool is_of_skylight(const IlluminanceOptions& options) {
  return options.decide && options.decide->of == DecisionThreshold::Of::Skylight;
}

Rgb not_below_zero(Rgb c) { return {std::max(0.0, c.r), std::max(0.0, c.g), std::max(0.0, c.b)}; }

/// What the paths of all sensors share.
struct PathLight {
  SkyCache cache;
  LampSampler lamps;
};

/// One sensor: its parts, refined where the gain is largest for the cost.
class SensorWork {
 public:
  struct Place {
    const Sensors& sensors;
    std::size_t index;
    Vec3 position() const { return sensors.position[index]; }
    Vec3 normal() const { return sensors.normal[index]; }
  };

  /// @param paths  null: no reflected light
  SensorWork(Place at, const RayVisibility& rays, const DaylightSource& source, PathLight* paths,
             const IlluminanceOptions& options)
      : options_(options),
        rays_(rays),
        elements_(options.by_slices ? nullptr : source.elements.get()),
        at_(at),
        sky_(rays, source.sky.get(), at.position(), at.normal(),
             SampleRandom(options.seed, at.index, 0),
             SensorSky::Effort{.first_slices = options.first_slices}),
        threshold_lux_(threshold_lux(options, source)),
        sun_(rays, source.sun, at.position(), at.normal(),
             mix_bits(mix_bits(options.seed) + at.index)) {
    if (options.known_direct != nullptr) known_direct_ = options.known_direct->lux[at.index];
    if (paths == nullptr) return;
    reflected_.emplace(ReflectedLight::Scene{rays, paths->cache, paths->lamps, options.lamps_apart},
                       options.bounces, at.position(), at.normal(),
                       SampleRandom(options.seed, at.index, 1));
  }

  /// Refines until the budget is met; false if the limit of effort came first, or if what no
  /// refinement mends (elements, bounces left out) is over the tolerance.
  bool finish(const ErrorBudget& budget, const Progress& progress) {
    if (known_direct_ < 0.0) {
      sun_.refine();
      see_sky(budget);
    }
    if (reflected_) {
      reflected_->set_way(ReflectedLight::way_for(options_.known_direct
                                                      ? options_.known_direct->sky_view[at_.index]
                                                      : light_of_sky().sky_view));
      reflected_->refine();
    }
    while (!is_clear()) {
      const bool is_exact = refinable_variance() <= budget.allowed_variance(total());
      if (is_exact && !wants_skylight(budget)) break;
      progress.stop_if_cancelled();
      if (is_exact) {
        sky_.refine();
      } else if (!refine_worst()) {
        return decided() != Decided::Undecided;
      }
    }
    return decided() != Decided::Undecided || interval() <= budget.allowed_lux(total());
  }

  Decided decided() const {
    if (!(threshold_lux_ > 0.0)) return Decided::Undecided;
    return decided_by(judged_lux(), judged_interval(ErrorBudget::kErrorsIn95), threshold_lux_);
  }

  void store(SensorIlluminance& values, std::size_t index) const {
    values.sun_lux[index] = sun_.lux();
    values.sky_lux[index] = light_of_sky().lux;
    values.reflected_lux[index] = std::max(0.0, reflected_lux());
    if (reflected_) values.reflected_rgb[index] = not_below_zero(reflected_->rgb());
    values.sky_view[index] = light_of_sky().sky_view;
    values.error_lux[index] = interval();
  }

  std::uint64_t rays_sent() const {
    return light_of_sky().rays + sun_.rays_sent() + (reflected_ ? reflected_->rays_sent() : 0);
  }

 private:
  void see_sky(const ErrorBudget& budget) {
    if (elements_ != nullptr) {
      by_elements_ = elements_->light(rays_, at_.position() + rays_.lift_m() * at_.normal(),
                                      at_.normal(), SampleRandom(options_.seed, at_.index, 0));
      return;
    }
    do {
      sky_.refine(std::max(budget.allowed_variance(total()), clear_variance()));
    } while (sky_.may_miss_openings() && sky_.slices() * options_.tolerance_pct < kSureOfDark);
  }

  ElementSky::Light light_of_sky() const {
    if (elements_ != nullptr) return by_elements_;
    return {sky_.lux(), sky_.variance(), sky_.sky_view(), sky_.rays_sent()};
  }
  double reflected_lux() const { return reflected_ ? reflected_->lux() : 0.0; }
  double reflected_variance() const { return reflected_ ? reflected_->variance() : 0.0; }
  double total() const {
    return std::max(0.0, known_direct_) + light_of_sky().lux + sun_.lux() + reflected_lux();
  }
  /// Without that of elements, which their count has settled.
  double refinable_variance() const {
    return sky_.variance() + sun_.variance() + reflected_variance();
  }
  double interval() const {
    return interval_lux(refinable_variance() + by_elements_.variance,
                        reflected_ ? reflected_->left_out_lux() : 0.0);
  }

  /// What is held against the threshold: the total, or the skylight in it.
  double judged_lux() const { return of_skylight_ ? light_of_sky().lux : total(); }
  double left_out_lux() const {
    return reflected_ && !of_skylight_ ? reflected_->left_out_lux() : 0.0;
  }
  double judged_variance() const {
    return of_skylight_ ? light_of_sky().variance : refinable_variance() + by_elements_.variance;
  }
  double judged_interval(double standard_errors) const {
    return standard_errors * std::sqrt(judged_variance()) + left_out_lux();
  }
  bool is_clear() const {
    return threshold_lux_ > 0.0 && decided_by(judged_lux(), judged_interval(kErrorsToStop),
                                              threshold_lux_) != Decided::Undecided;
  }
  /// Variance that the value, as it is now, may have to be clear of the threshold.
  double clear_variance() const {
    if (!(threshold_lux_ > 0.0) || (reflected_ && !of_skylight_)) return 0.0;
    const double sd = std::abs(judged_lux() - threshold_lux_) / kErrorsToStop;
    return sd * sd;
  }
  /// Whether the skylight by itself is to be told from the threshold, and is not exact enough.
  bool wants_skylight(const ErrorBudget& budget) const {
    return of_skylight_ && elements_ == nullptr && known_direct_ < 0.0 &&
           sky_.slices() < options_.most_slices &&
           sky_.variance() > budget.allowed_variance(sky_.lux());
  }

  /// Doubles the effort of the part where that gains the most for its rays, of those that can
  /// still be refined.
  bool refine_worst() {
    const auto gain = [](bool can, double variance, std::uint64_t rays) {
      return can ? variance / static_cast<double>(std::max<std::uint64_t>(rays, 1)) : 0.0;
    };
    const auto most_paths = static_cast<std::uint64_t>(options_.most_paths);
    const double sky =
        gain(sky_.slices() < options_.most_slices, sky_.variance(), sky_.rays_sent());
    const double sun = gain(sun_.rays_sent() < most_paths, sun_.variance(), sun_.rays_sent());
    const double reflected = reflected_ ? gain(reflected_->paths() < options_.most_paths,
                                               reflected_->variance(), reflected_->rays_sent())
                                        : 0.0;
    const double most = std::max({sky, sun, reflected});
    if (!(most > 0.0)) return false;
    if (most == reflected) {
      reflected_->refine();
    } else if (most == sky) {
      sky_.refine();
    } else {
      sun_.refine();
    }
    return true;
  }

  const IlluminanceOptions& options_;
  const RayVisibility& rays_;
  const ElementSky* elements_;
  Place at_;
  ElementSky::Light by_elements_;
  SensorSky sky_;
  double threshold_lux_;  ///< below zero: none
  bool of_skylight_ = is_of_skylight(options_);
  SensorSun sun_;
  std::optional<ReflectedLight> reflected_;
  double known_direct_ = -1.0;  ///< below zero: not known
};

std::string place_of(const Sensors& sensors, std::size_t i) {
  const Vec3 at = sensors.position[i];
  std::ostringstream text;
  text.precision(1);
  text << std::fixed << "sensor " << i + 1 << ", " << at.x << " m east, " << at.y << " m north, "
       << at.z << " m up of the origin";
  return text.str();
}

}  // namespace

bool is_dark(const SensorIlluminance& values, std::size_t sensor) {
  return !(values.sky_view[sensor] > 0.0) && !(values.total_lux(sensor) > kDark_lux);
}

void find_dark_sensors(const Sensors& sensors, const SensorIlluminance& values,
                       std::vector<Finding>& findings) {
  Finding dark;
  dark.code = "no_light";
  dark.what = "sensors see no sky and receive no light: inside a wall or a closed room?";
  dark.repair = "move them into the open, or check which way their normals point";
  dark.count = 0;
  std::erase_if(findings, [&](const Finding& f) { return f.code == dark.code; });
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (is_dark(values, i) && dark.count++ == 0) dark.where = place_of(sensors, i);
  }
  if (dark.count > 0) findings.push_back(std::move(dark));
}

std::optional<Finding> sensors_on_edges(const Sensors& sensors, const RayVisibility& rays) {
  std::vector<std::uint8_t> is_on(sensors.size());
  parallel_for(sensors.size(), kGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Vec3 origin = sensors.position[i] + rays.lift_m() * sensors.normal[i];
      is_on[i] = rays.triangle_at(origin).has_value();
    }
  });
  const auto first = std::find(is_on.begin(), is_on.end(), 1);
  if (first == is_on.end()) return std::nullopt;
  const auto count = static_cast<std::size_t>(std::count(first, is_on.end(), 1));
  return Finding{"sensor_on_edge",
                 Severity::Warning,
                 "",
                 place_of(sensors, static_cast<std::size_t>(first - is_on.begin())),
                 "sensors stand on an edge of a surface or within it: on which side of it they are "
                 "is open, and their values are those of either side",
                 "move them off it, by 0.1 mm or more",
                 count};
}

void tell_missed(IlluminanceResult& result) {
  Finding finding;
  finding.code = "tolerance_not_reached";
  finding.what = "sensors are less exact than the tolerance; error_lux tells how exact";
  finding.repair =
      "a higher tolerance, more bounces where few were asked for, more elements of a sky divided "
      "by hand, or take them so";
  finding.count = static_cast<std::size_t>(
      std::count(result.is_missed.begin(), result.is_missed.end(), std::uint8_t{1}));
  result.out_of_tolerance = finding.count;
  std::erase_if(result.findings, [&](const Finding& f) { return f.code == finding.code; });
  if (finding.count > 0) result.findings.push_back(std::move(finding));
}

namespace {

/// After the reflected light has been added to direct light: what is still dark, and what is not
/// exact enough for `options`.
void judge_whole(const Sensors& sensors, const DaylightSource& source,
                 const IlluminanceOptions& options, IlluminanceResult& result) {
  const ErrorBudget budget(options.tolerance_pct, options.floor_share * source.unobstructed_lux());
  const SensorIlluminance& values = result.values;
  if (budget.allowed_lux(0.0) > 0.0) find_dark_sensors(sensors, values, result.findings);
  for (std::size_t s = 0; s < values.size(); ++s) {
    result.is_missed[s] |= !(values.error_lux[s] <= budget.allowed_lux(values.total_lux(s)));
  }
  decide_totals(source, options, result);
  tell_missed(result);
}

}  // namespace

void decide_totals(const DaylightSource& source, const IlluminanceOptions& options,
                   IlluminanceResult& result) {
  if (!options.decide) return;
  const double threshold = threshold_lux(options, source);
  const SensorIlluminance& values = result.values;
  if (!is_of_skylight(options)) {
    result.decided.resize(values.size());
    for (std::size_t s = 0; s < values.size(); ++s) {
      result.decided[s] = decided_by(values.total_lux(s), values.error_lux[s], threshold);
    }
  }
  for (std::size_t s = 0; s < values.size(); ++s) {
    if (result.decided[s] != Decided::Undecided) result.is_missed[s] = 0;
  }
}

IlluminanceResult illuminate(const Sensors& sensors, const RayVisibility& rays,
                             const DaylightSource& source, const IlluminanceOptions& options,
                             Progress& progress) {
  check_options(options);
  const bool is_apart = options.share_reflected_m > 0.0 || options.reflection != nullptr;
  if (is_apart && options.bounces > 0 && !options.known_direct) {
    // Direct light of every sensor; then reflected light, or that of some spread over the others.
    IlluminanceOptions direct = options;
    direct.bounces = 0;
    if (!is_of_skylight(options)) direct.decide.reset();  // what is reflected is still to come
    IlluminanceResult result = illuminate(sensors, rays, source, direct, progress);
    add_reflection(sensors, rays, source, options, progress, result);
    return result;
  }
  const ErrorBudget budget(options.tolerance_pct, options.floor_share * source.unobstructed_lux());
  IlluminanceResult result;
  result.values = SensorIlluminance(sensors.size());
  result.is_missed.resize(sensors.size());
  threshold_lux(options, source);  // refuses what it cannot decide
  if (options.decide) result.decided.resize(sensors.size());
  std::atomic<std::uint64_t> rays_sent{0};
  std::unique_ptr<PathLight> paths;
  if (options.bounces > 0) {
    paths.reset(new PathLight{{rays, source, options.seed}, LampSampler(rays)});
  }
  progress.begin(options.known_direct ? "reflected light" : "illuminance", sensors.size());
  parallel_for(sensors.size(), kGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      progress.stop_if_cancelled();
      SensorWork work({sensors, i}, rays, source, paths.get(), options);
      result.is_missed[i] = !work.finish(budget, progress);
      work.store(result.values, i);
      if (options.decide) result.decided[i] = work.decided();
      rays_sent += work.rays_sent();
    }
    progress.advance(range.end - range.begin);
  });
  result.rays = rays_sent + (paths ? paths->cache.rays_sent() : 0);
  tell_missed(result);
  if (options.known_direct == nullptr && source.unobstructed_lux() > 0.0) {
    find_dark_sensors(sensors, result.values, result.findings);
  }
  progress.end(std::to_string(sensors.size()) + " sensors, " + std::to_string(result.rays) +
               " rays");
  return result;
}

void add_shared_reflection(const ReflectedSharing& sharing, const RayVisibility& rays,
                           const DaylightSource& source, const IlluminanceOptions& options,
                           Progress& progress, IlluminanceResult& result) {
  const Sensors few = sensors_of(sharing.sensors(), sharing.calculated());
  if (options.reflection != nullptr) {
    SensorIlluminance values(few.size());
    for (std::size_t k = 0; k < few.size(); ++k) {
      values.sky_lux[k] = result.values.sky_lux[sharing.calculated()[k]];
    }
    options.reflection->all(few, values, progress);
    sharing.spread(values, result.values);
    return;
  }
  IlluminanceOptions::KnownDirect known;
  for (const std::uint32_t s : sharing.calculated()) {
    // Without sunlight: the sensor may stand for others in the shade beside it.
    known.lux.push_back(result.values.sky_lux[s]);
    known.sky_view.push_back(result.values.sky_view[s]);
  }
  IlluminanceOptions reflected = options;
  reflected.share_reflected_m = 0.0;
  reflected.known_direct = &known;
  reflected.decide.reset();
  const IlluminanceResult some = illuminate(few, rays, source, reflected, progress);
  sharing.spread(some.values, result.values);
  result.rays += some.rays;
  for (std::size_t k = 0; k < few.size(); ++k) {
    result.is_missed[sharing.calculated()[k]] |= some.is_missed[k];
  }
  tell_missed(result);
}

IlluminanceOptions options_for_sharing(const IlluminanceOptions& options) {
  IlluminanceOptions reflected = options;
  reflected.floor_share = 0.01;  // what is shared is not exact to that in any case
  reflected.tolerance_pct = std::min(100.0, kBlended * options.tolerance_pct);
  reflected.most_paths = std::min(options.most_paths, kMostSharedPaths);
  return reflected;
}

void add_reflection(const Sensors& sensors, const RayVisibility& rays, const DaylightSource& source,
                    const IlluminanceOptions& options, Progress& progress,
                    IlluminanceResult& result) {
  IlluminanceOptions reflected = options;
  if (options.share_reflected_m > 0.0) {
    reflected = options_for_sharing(options);
    const ReflectedSharing sharing(
        sensors, sharing_by_distance(sensors, result.values.sky_view, options.share_reflected_m),
        rays);
    add_shared_reflection(sharing, rays, source, reflected, progress, result);
    return judge_whole(sensors, source, options, result);
  }
  if (options.reflection != nullptr) {
    options.reflection->all(sensors, result.values, progress);
    return judge_whole(sensors, source, options, result);
  }
  IlluminanceOptions::KnownDirect known;
  for (std::size_t s = 0; s < sensors.size(); ++s) known.lux.push_back(result.values.total_lux(s));
  known.sky_view = result.values.sky_view;
  reflected.known_direct = &known;
  reflected.decide.reset();
  const IlluminanceResult more = illuminate(sensors, rays, source, reflected, progress);
  result.rays += more.rays;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    result.values.reflected_lux[s] = more.values.reflected_lux[s];
    result.values.reflected_rgb[s] = more.values.reflected_rgb[s];
    result.values.error_lux[s] = std::hypot(result.values.error_lux[s], more.values.error_lux[s]);
    result.is_missed[s] |= more.is_missed[s];
  }
  judge_whole(sensors, source, options, result);
}

}  // namespace tenku
