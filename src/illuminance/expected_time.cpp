#include "illuminance/expected_time.h"

#include <algorithm>
#include <cmath>

#include "core/stopwatch.h"
#include "illuminance/planned_light.h"

namespace tenku {
namespace {

constexpr std::size_t kRuns = 16;         // of neighbours
constexpr double kOfAll = 0.05;           // the sensors in them
constexpr std::size_t kLeastRun = 64;     // sensors
constexpr double kRoughly_pct = 20.0;     // tolerance of their direct light
constexpr double kSharingPilots = 600.0;  // ReflectedSharing draws so many beside representatives

Sensors evenly_of(const Sensors& all, std::size_t count) {
  std::vector<std::uint32_t> chosen;
  for (std::size_t k = 0; k < count; ++k) {
    chosen.push_back(static_cast<std::uint32_t>(k * all.size() / count));
  }
  return sensors_of(all, chosen);
}

/// Of all sensors, from two counts of them.
template <class Run>
double seconds_by_two(const Sensors& sensors, const Run& run) {
  constexpr std::size_t kFew = 64, kMore = 256;
  const auto seconds = [&](std::size_t count) {
    const Sensors some = evenly_of(sensors, count);
    const Stopwatch watch;
    run(some);
    return watch.seconds();
  };
  const std::size_t more = std::min(kMore, sensors.size()), few = std::min(kFew, more / 2);
  if (few == 0) return seconds(more);
  const double first = seconds(few), second = seconds(more);
  return second + std::max(0.0, second - first) * static_cast<double>(sensors.size() - more) /
                      static_cast<double>(more - few);
}

Sensors runs_of_neighbours(const Sensors& all) {
  const auto wanted = static_cast<std::size_t>(kOfAll * static_cast<double>(all.size()) / kRuns);
  const std::size_t length = std::max(kLeastRun, wanted);
  if (kRuns * length >= all.size()) return all;
  std::vector<std::uint32_t> chosen;
  for (std::size_t r = 0; r < kRuns; ++r) {
    const std::size_t first = r * (all.size() - length) / (kRuns - 1);
    for (std::size_t k = 0; k < length; ++k) {
      chosen.push_back(static_cast<std::uint32_t>(first + k));
    }
  }
  return sensors_of(all, chosen);
}

double shared_reflection_s(const Sensors& sensors, const RayVisibility& rays,
                           const DaylightSource& source, const IlluminanceOptions& options) {
  const Sensors some = runs_of_neighbours(sensors);
  IlluminanceOptions direct = options;
  direct.bounces = 0;
  direct.share_reflected_m = 0.0;
  direct.tolerance_pct = std::max(options.tolerance_pct, kRoughly_pct);
  Progress quiet;
  const IlluminanceResult seen = illuminate(some, rays, source, direct, quiet);
  SharingLayout layout = sharing_by_distance(some, seen.values.sky_view, options.share_reflected_m);
  layout.is_measured = false;
  const ReflectedSharing sharing(some, std::move(layout), rays);
  const Sensors representatives = sensors_of(some, sharing.calculated());
  if (representatives.size() == 0) return 0.0;
  const double whole = static_cast<double>(sensors.size());
  const double share =
      static_cast<double>(representatives.size()) / static_cast<double>(some.size());
  const double count = std::min(whole, share * whole + kSharingPilots);
  return predicted_reflection_s(representatives, rays, source, options_for_sharing(options)) *
         count / static_cast<double>(representatives.size());
}

double reflection_s(const Sensors& sensors, const RayVisibility& rays, const DaylightSource& source,
                    const IlluminanceOptions& options) {
  if (options.bounces == 0) return 0.0;
  if (options.reflection != nullptr) {
    return seconds_by_two(sensors, [&](const Sensors& some) {
      SensorIlluminance values(some.size());
      Progress quiet;
      options.reflection->all(some, values, quiet);
    });
  }
  if (options.share_reflected_m > 0.0) return shared_reflection_s(sensors, rays, source, options);
  return predicted_reflection_s(sensors, rays, source, options);
}

double direct_s(const Sensors& sensors, const Engines& engines, const DaylightSource& source,
                const IlluminanceOptions& options, LightMethod method) {
  method.is_predicted = true;
  IlluminanceOptions direct = options;
  direct.bounces = 0;
  Progress quiet;
  const Stopwatch watch;
  double sum = 0.0;
  for (const RegionWork& region : plan_light(sensors, engines, source, direct, method, quiet)) {
    sum += region.told.predicted_s();
  }
  if (std::isfinite(sum)) return sum + watch.seconds();
  return seconds_by_two(sensors, [&](const Sensors& some) {
    illuminate(some, engines, source, direct, method, quiet);
  });
}

}  // namespace

double expected_light_s(const Sensors& sensors, const Engines& engines,
                        const DaylightSource& source, const IlluminanceOptions& options,
                        const LightMethod& method) {
  if (sensors.size() == 0) return 0.0;
  if (options.decide) {
    return seconds_by_two(sensors, [&](const Sensors& some) {
      Progress quiet;
      illuminate(some, engines, source, options, method, quiet);
    });
  }
  return direct_s(sensors, engines, source, options, method) +
         reflection_s(sensors, engines.rays(), source, options);
}

}  // namespace tenku
