#include "radiosity/settled_looks.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "illuminance/error_budget.h"
#include "illuminance/reflected_sharing.h"
#include "radiosity/corner_solution.h"

namespace tenku {
namespace {

constexpr double kDim = 0.01;  // of the mean light from sides: dimmer sensors are held to it

/// Sensors that face one way have one number.
std::vector<std::uint32_t> facings(const Sensors& sensors) {
  std::map<std::uint64_t, std::uint32_t> number;
  std::vector<std::uint32_t> of_sensor;
  for (const Vec3 n : sensors.normal) {
    const auto next = static_cast<std::uint32_t>(number.size());
    of_sensor.push_back(number.emplace(facing(n), next).first->second);
  }
  return of_sensor;
}

double floor_of(const std::vector<PointGather::Looks>& looks) {
  double sum = 0.0;
  for (const auto& look : looks) sum += luminance_of(mean_of(look));
  return kDim * sum / static_cast<double>(std::max<std::size_t>(looks.size(), 1));
}

}  // namespace

// The error of samples falls with their number to the power -3/4. Half a step more, since a look
// that still is not enough is thrown away.
std::uint8_t steps_finer(double interval_lux, double allowed_lux) {
  if (!(interval_lux > allowed_lux)) return 0;
  return static_cast<std::uint8_t>(
      std::clamp(std::ceil(std::log2(interval_lux / allowed_lux) * 4.0 / 3.0 + 0.5), 1.0, 8.0));
}

int resolution_at(int first, std::size_t level) {
  return static_cast<int>(std::lround(first * std::pow(2.0, 0.5 * static_cast<double>(level))));
}

SettledLooks settle_looks(const Sensors& sensors, const SensorIlluminance& values,
                          double tolerance_pct, const LookAtSides& look, const LookFiner& finer) {
  const std::vector<std::uint32_t> group = facings(sensors);
  LooksOfSensors looks{std::vector<PointGather::Looks>(values.size()),
                       std::vector<std::array<double, PointGather::kLooks>>(values.size())};
  SettledLooks settled;
  std::vector<std::uint8_t> rough(values.size(), 1);
  double floor_lux = 0.0;
  do {
    look(rough, looks);
    settled.variance = pooled_variance(looks.lux, group);
    if (floor_lux == 0.0) floor_lux = floor_of(looks.lux);
    const ErrorBudget budget(0.5 * tolerance_pct, floor_lux);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double lux =
          values.sun_lux[i] + values.sky_lux[i] + luminance_of(mean_of(looks.lux[i]));
      rough[i] = steps_finer(interval_lux(settled.variance[i], 0.0), budget.allowed_lux(lux));
    }
  } while (finer(rough));
  for (std::size_t i = 0; i < values.size(); ++i) {
    settled.lux.push_back(mean_of(looks.lux[i]));
    settled.mesh_lux.push_back(0.5 * (looks.mesh_lux[i][0] + looks.mesh_lux[i][1]));
  }
  return settled;
}

}  // namespace tenku
