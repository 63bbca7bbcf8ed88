#include "illuminance/planned_light.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/stopwatch.h"
#include "illuminance/error_budget.h"
#include "illuminance/paper_detail.h"
#include "illuminance/shared_light.h"
#include "illuminance/sky_interpolation.h"

namespace tenku {
namespace {

/// Carries a plan out, region by region.
class PlannedLight {
 public:
  PlannedLight(const Sensors& sensors, const Engines& engines, const DaylightSource& source,
               const IlluminanceOptions& options, const LightMethod& method, Progress& progress)
      : sensors_(sensors),
        engines_(engines),
        source_(source),
        options_(options),
        method_(method),
        progress_(progress) {
    result_.values = SensorIlluminance(sensors.size());
    result_.is_missed.resize(sensors.size());
    options_.bounces = 0;
    options_.decide.reset();  // what maps find is held against it afterwards
  }

  void light(RegionWork& work) {
    const Stopwatch watch;
    if (!work.told.is_shared) {
      by_rays(work);
    } else {
      by_shared_elements(work);
    }
    work.told.measured_s = watch.seconds();
    double sum = 0.0;
    for (const std::uint32_t s : work.sensor) sum += result_.values.error_lux[s];
    work.told.measured_error_lux = sum / static_cast<double>(work.sensor.size());
    result_.regions.push_back(work.told);
  }

  IlluminanceResult take() {
    tell_missed(result_);
    if (source_.unobstructed_lux() > 0.0)
      find_dark_sensors(sensors_, result_.values, result_.findings);
    return std::move(result_);
  }

 private:
  void by_rays(RegionWork& work) {
    const Sensors here = sensors_of(sensors_, work.sensor);
    const IlluminanceResult part =
        work.told.may_interpolate ? illuminate_sparsely(here, engines_.rays(), source_, options_,
                                                        progress_, &work.told.interpolated)
                                  : illuminate(here, engines_.rays(), source_, options_, progress_);
    take_direct(part, work.sensor, result_);
  }

  void by_shared_elements(const RegionWork& work) {
    const PlannedRegion& told = work.told;
    const Sensors at = lifted(sensors_of(sensors_, work.sensor), engines_.rays().lift_m());
    SkyPartition partition;
    if (source_.model != nullptr) partition = partition_sky(*source_.model, work.partition);
    const int suns = static_cast<int>(told.sun_directions);
    SharedElements::Wanted wanted;
    const SharedElements elements(partition, source_.sky.get());
    if (method_.detail == Detail::Paper) wanted = wanted_by(work, elements);
    const SharedElements::Wanted* some = method_.detail == Detail::Paper ? &wanted : nullptr;
    SharedLight light;
    if (told.engine == Engine::Rays) {
      light = shared_light(engines_.rays(), engines_.rays(), at, source_, elements, suns, progress_,
                           some);
      result_.rays += at.size() * (told.elements + told.sun_directions);
    } else {
      const ShadowMaps near = engines_.maps().with(told.texels, told.reach_m);
      const ShadowMaps all = engines_.maps().with(told.texels);
      light = shared_light(near, all, at, source_, elements, suns, progress_, some);
    }
    store(work, light);
  }

  SharedElements::Wanted wanted_by(const RegionWork& work, const SharedElements& elements) const {
    SeenPolygons seen;
    seen.normal = method_.polygons->normal;
    seen.pixels = method_.polygons->pixels;
    for (const std::uint32_t s : work.sensor) {
      seen.of_sensor.push_back(method_.polygons->of_sensor[s]);
    }
    return paper_detail(elements, seen, method_.mu);
  }

  void store(const RegionWork& work, const SharedLight& light) {
    std::vector<double> value, scale;
    for (const std::uint32_t k : work.pilots.sensor) {
      value.push_back(light.sky_lux[k] + light.sun_lux[k]);
      scale.push_back(light.scale_lux[k]);
    }
    const double factor = work.pilots.interval_per_scale(value, scale);
    // In a picture what is dark need not be exact.
    const double floor_share = method_.picture_tolerance_pct > 0.0 ? 1.0 : options_.floor_share;
    const ErrorBudget budget(options_.tolerance_pct, floor_share * source_.unobstructed_lux());
    for (std::size_t k = 0; k < work.sensor.size(); ++k) {
      const std::uint32_t s = work.sensor[k];
      result_.values.sun_lux[s] = light.sun_lux[k];
      result_.values.sky_lux[s] = light.sky_lux[k];
      result_.values.sky_view[s] = std::clamp(light.sky_view[k], 0.0, 1.0);
      result_.values.error_lux[s] = factor * light.scale_lux[k];
      result_.is_missed[s] =
          result_.values.error_lux[s] > budget.allowed_lux(light.sky_lux[k] + light.sun_lux[k]);
    }
  }

  const Sensors& sensors_;
  const Engines& engines_;
  const DaylightSource& source_;
  IlluminanceOptions options_;
  const LightMethod& method_;
  Progress& progress_;
  IlluminanceResult result_;
};

bool is_each_for_itself(const std::vector<RegionWork>& plan) {
  return std::none_of(plan.begin(), plan.end(), [](const RegionWork& work) {
    return work.told.is_shared || work.told.may_interpolate;
  });
}

/// Skylight alone, with the interval of sun and sky together: no decision errs for that.
void hold_direct_against(const DecisionThreshold& threshold, const DaylightSource& source,
                         IlluminanceResult& result) {
  if (threshold.of != DecisionThreshold::Of::Skylight) return;
  const double lux = threshold.lux(source.sky ? source.sky->horizontal_lux() : 0.0);
  const SensorIlluminance& values = result.values;
  result.decided.resize(values.size());
  for (std::size_t s = 0; s < values.size(); ++s) {
    result.decided[s] = decided_by(values.sky_lux[s], values.error_lux[s], lux);
  }
}

/// Rays light all regions at once: one line for all of them.
PlannedRegion told_together(const std::vector<RegionWork>& plan) {
  PlannedRegion all = plan.front().told;
  for (std::size_t r = 1; r < plan.size(); ++r) {
    const PlannedRegion& more = plan[r].told;
    const double sensors = static_cast<double>(all.sensors),
                 others = static_cast<double>(more.sensors);
    all.predicted_error_lux =
        (sensors * all.predicted_error_lux + others * more.predicted_error_lux) /
        (sensors + others);
    all.sensors += more.sensors;
    all.rays_s += more.rays_s, all.shared_s += more.shared_s, all.maps_s += more.maps_s;
  }
  return all;
}

}  // namespace

void take_direct(const IlluminanceResult& part, std::span<const std::uint32_t> places,
                 IlluminanceResult& whole) {
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::uint32_t s = places[k];
    whole.values.sun_lux[s] = part.values.sun_lux[k];
    whole.values.sky_lux[s] = part.values.sky_lux[k];
    whole.values.sky_view[s] = part.values.sky_view[k];
    whole.values.error_lux[s] = part.values.error_lux[k];
    whole.is_missed[s] = part.is_missed[k];
  }
  whole.rays += part.rays;
}

IlluminanceResult illuminate(const Sensors& sensors, const Engines& engines,
                             const DaylightSource& source, const IlluminanceOptions& options,
                             const LightMethod& method, Progress& progress) {
  if (method.detail == Detail::Paper && method.polygons == nullptr) {
    throw InputError(
        "the paper's level of detail goes by the size of polygons in a picture: sensors have none; "
        "use --lod budget or off");
  }
  // Each sensor stops by itself: the others' rays are spared, and nothing is taken from neighbours.
  if (options.decide && method.engine != EngineChoice::ShadowMaps &&
      method.detail != Detail::Paper) {
    return illuminate(sensors, engines.rays(), source, options, progress);
  }
  std::vector<RegionWork> plan = plan_light(sensors, engines, source, options, method, progress);
  if (is_each_for_itself(plan)) {
    const Stopwatch watch;
    IlluminanceResult result = illuminate(sensors, engines.rays(), source, options, progress);
    const double seconds = watch.seconds();
    if (plan.empty()) return result;
    result.regions = {told_together(plan)};
    // With reflected light the two cannot be told apart.
    if (options.bounces == 0) result.regions.front().measured_s = seconds;
    result.regions.front().measured_error_lux = result.values.mean_error_lux();
    return result;
  }
  PlannedLight light(sensors, engines, source, options, method, progress);
  for (RegionWork& work : plan) light.light(work);
  IlluminanceResult result = light.take();
  if (options.decide) hold_direct_against(*options.decide, source, result);
  if (options.bounces > 0) {
    add_reflection(sensors, engines.rays(), source, options, progress, result);
  } else if (options.decide) {
    decide_totals(source, options, result);
    tell_missed(result);
  }
  return result;
}

double predicted_reflection_s(const Sensors& sensors, const RayVisibility& rays,
                              const DaylightSource& source, const IlluminanceOptions& options) {
  constexpr std::size_t kFew = 64, kMore = 256;
  if (options.bounces == 0) return 0.0;
  const auto seconds = [&](std::size_t count, int bounces) {
    std::vector<std::uint32_t> chosen;
    for (std::size_t k = 0; k < count; ++k) {
      chosen.push_back(static_cast<std::uint32_t>(k * sensors.size() / count));
    }
    IlluminanceOptions some = options;
    some.share_reflected_m = 0.0;
    some.bounces = bounces;
    Progress quiet;
    const Stopwatch watch;
    illuminate(sensors_of(sensors, chosen), rays, source, some, quiet);
    return watch.seconds();
  };
  const std::size_t more = std::min(kMore, sensors.size()), few = std::min(kFew, more / 2);
  if (few == 0) return seconds(more, options.bounces) - seconds(more, 0);
  const double with = seconds(more, options.bounces) - seconds(few, options.bounces);
  const double without = seconds(more, 0) - seconds(few, 0);
  return std::max(0.0, with - without) * static_cast<double>(sensors.size()) /
         static_cast<double>(more - few);
}

}  // namespace tenku
