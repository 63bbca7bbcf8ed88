#include "illuminance/sensor.h"

#include <algorithm>
#include <numeric>

namespace tenku {

Sensors sensors_of(const Sensors& all, std::span<const std::uint32_t> chosen) {
  Sensors some;
  some.position.reserve(chosen.size());
  some.normal.reserve(chosen.size());
  for (const std::uint32_t s : chosen) {
    some.position.push_back(all.position[s]);
    some.normal.push_back(all.normal[s]);
  }
  return some;
}

Sensors lifted(Sensors sensors, double lift_m) {
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    sensors.position[s] = sensors.position[s] + lift_m * sensors.normal[s];
  }
  return sensors;
}

double SensorIlluminance::mean_error_lux() const {
  return std::accumulate(error_lux.begin(), error_lux.end(), 0.0) /
         static_cast<double>(std::max<std::size_t>(1, error_lux.size()));
}

}  // namespace tenku
