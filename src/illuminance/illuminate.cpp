#include "illuminance/illuminate.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "illuminance/sensor_sky.h"
#include "illuminance/sensor_sun.h"

namespace tenku {
namespace {

constexpr std::size_t kGrain = 16;  // sensors a task

void check_options(const IlluminanceOptions& options) {
  if (!(options.tolerance_pct > 0.0 && options.tolerance_pct <= 100.0)) {
    throw InputError("tolerance " + std::to_string(options.tolerance_pct) +
                     " is not in (0, 100] percent");
  }
  if (options.bounces < 0 || options.bounces > 100) {
    throw InputError("bounces " + std::to_string(options.bounces) + " is not in 0..100");
  }
}

/// One sensor: its parts, refined where the gain is largest for the cost.
class SensorWork {
 public:
  SensorWork(const Sensors& sensors, std::size_t index, const RayVisibility& rays,
             const DaylightSource& source, const IlluminanceOptions& options)
      : options_(options),
        sky_(rays, source.sky.get(), sensors.position[index], sensors.normal[index],
             SampleRandom(options.seed, index, 0)),
        sun_(rays, source.sun, sensors.position[index], sensors.normal[index],
             mix_bits(mix_bits(options.seed) + index)) {}

  /// Refines until the budget is met; false if the limit of effort came first.
  bool finish(const ErrorBudget& budget) {
    sun_.refine();
    sky_.refine();
    while (variance() > budget.allowed_variance(total())) {
      if (!refine_worst()) return false;
    }
    return true;
  }

  void store(SensorIlluminance& values, std::size_t index) const {
    values.sun_lux[index] = sun_.lux();
    values.sky_lux[index] = sky_.lux();
    values.reflected_lux[index] = 0.0;
    values.sky_view[index] = sky_.sky_view();
    values.error_lux[index] = interval_lux(variance(), 0.0);
  }

  std::uint64_t rays_sent() const { return sky_.rays_sent() + sun_.rays_sent(); }

 private:
  double total() const { return sky_.lux() + sun_.lux(); }
  double variance() const { return sky_.variance() + sun_.variance(); }

  bool refine_worst() {
    const bool sky_can = sky_.slices() < options_.most_slices;
    const bool sun_can = !sun_.is_settled();
    if (sun_can && (sun_.variance() >= sky_.variance() || !sky_can)) {
      sun_.refine();
    } else if (sky_can) {
      sky_.refine();
    }
    return sky_can || sun_can;
  }

  const IlluminanceOptions& options_;
  SensorSky sky_;
  SensorSun sun_;
};

}  // namespace

double DaylightSource::unobstructed_lux() const {
  const double from_sun = sun.normal_illuminance.value() * std::max(0.0, sun.direction.z);
  return (sky ? sky->horizontal_lux() : 0.0) + from_sun;
}

IlluminanceResult illuminate(const Sensors& sensors, const RayVisibility& rays,
                             const DaylightSource& source, const IlluminanceOptions& options,
                             Progress& progress) {
  check_options(options);
  const ErrorBudget budget(options.tolerance_pct, source.unobstructed_lux());
  IlluminanceResult result;
  result.values = SensorIlluminance(sensors.size());
  std::atomic<std::uint64_t> rays_sent{0};
  std::atomic<std::size_t> missed{0};
  progress.begin("illuminance", sensors.size());
  parallel_for(sensors.size(), kGrain, [&](IndexRange range) {
    progress.stop_if_cancelled();
    for (std::size_t i = range.begin; i < range.end; ++i) {
      SensorWork work(sensors, i, rays, source, options);
      if (!work.finish(budget)) ++missed;
      work.store(result.values, i);
      rays_sent += work.rays_sent();
    }
    progress.advance(range.end - range.begin);
  });
  result.rays = rays_sent;
  result.out_of_tolerance = missed;
  progress.end(std::to_string(sensors.size()) + " sensors, " + std::to_string(result.rays) +
               " rays");
  return result;
}

}  // namespace tenku
