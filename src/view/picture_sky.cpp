#include "view/picture_sky.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.h"

namespace tenku {
namespace {

constexpr double kDim = 0.01;         // of the mean light: darker places are held to it
constexpr double kLeastPoints = 3.0;  // that tell how values scatter

/// Weighted sums of values around a point.
struct Around {
  double weight = 0.0, squared_weight = 0.0, sky = 0.0, squares = 0.0, sun = 0.0;

  Around(const ShadingPoints& points, const SensorIlluminance& light, std::size_t i) {
    points.for_each_near(i, 1, [&](std::size_t k, double w) {
      weight += w, squared_weight += w * w;
      sky += w * light.sky_lux[k], squares += w * light.sky_lux[k] * light.sky_lux[k];
      sun += w * light.sun_lux[k];
    });
  }
  double mean() const { return sky / weight; }
  double total() const { return (sky + sun) / weight; }
  /// As many of equal weight as tell as much.
  double count() const { return weight * weight / squared_weight; }
  /// Standard error of the mean.
  double error() const {
    const double variance = std::max(0.0, squares / weight - mean() * mean());
    return std::sqrt(variance / (count() - 1.0));
  }
};

}  // namespace

std::vector<std::uint32_t> scattered_sky(const ShadingPoints& points,
                                         const SensorIlluminance& light, double tolerance) {
  double sum = 0.0;
  for (std::size_t i = 0; i < light.size(); ++i) sum += light.sky_lux[i] + light.sun_lux[i];
  const double floor_lux = kDim * sum / static_cast<double>(std::max<std::size_t>(light.size(), 1));
  std::vector<std::uint8_t> is_scattered(light.size());
  parallel_for(light.size(), 1024, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Around around(points, light, i);
      is_scattered[i] = around.count() >= kLeastPoints &&
                        around.error() > tolerance * std::max(around.total(), floor_lux);
    }
  });
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < is_scattered.size(); ++i) {
    if (is_scattered[i] != 0) found.push_back(i);
  }
  return found;
}

void smooth_sky(const ShadingPoints& points, SensorIlluminance& light) {
  std::vector<double> mean(points.sensors.size());
  parallel_for(mean.size(), 1024, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) mean[i] = Around(points, light, i).mean();
  });
  light.sky_lux = std::move(mean);
}

}  // namespace tenku
