#include "radiosity/sky_weights.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/vec3.h"

namespace tenku {
namespace {

constexpr double kDegree = kPi / 180.0;
// Altitudes for which two points stand: near the horizon skies change the most.
constexpr double kLow = 30.0 * kDegree, kLongestLow = 10.0 * kDegree, kLongestHigh = 20.0 * kDegree;
constexpr std::size_t kGrain = 1024;

/// The whole number below or above, each with the chance of being as near.
std::uint32_t rounded_at_random(double place, SampleRandom& random) {
  return static_cast<std::uint32_t>(place + random.uniform());
}

/// Sines and cosines of so many angles, a degree apart.
std::vector<std::array<double, 2>> circle(std::uint32_t count) {
  std::vector<std::array<double, 2>> points;
  for (std::uint32_t k = 0; k < count; ++k) {
    points.push_back({std::sin(k * kDegree), std::cos(k * kDegree)});
  }
  return points;
}

}  // namespace

std::uint16_t SkyGrid::node_near(double azimuth_rad, double altitude_rad, SampleRandom& random) {
  const double turns = azimuth_rad / (2.0 * kPi);
  const std::uint32_t column =
      rounded_at_random((turns - std::floor(turns)) * kColumns, random) % kColumns;
  const std::uint32_t row =
      std::min(rounded_at_random(std::max(altitude_rad, 0.0) / kDegree, random), kRows - 1);
  return static_cast<std::uint16_t>(row * kColumns + column);
}

std::vector<float> SkyGrid::luminances(const SkyModel& sky,
                                       std::span<const std::uint8_t> is_wanted) {
  static const auto azimuth = circle(kColumns), altitude = circle(kRows);
  std::vector<float> luminance(kNodes);
  parallel_for(kNodes, kGrain, [&](IndexRange range) {
    for (std::size_t k = range.begin; k < range.end; ++k) {
      if (is_wanted[k] == 0) continue;
      const auto [east, north] = azimuth[k % kColumns];
      const auto [up, level] = altitude[k / kColumns];
      const Vec3 direction{level * east, level * north, up};
      luminance[k] = static_cast<float>(sky.luminance(direction).value());
    }
  });
  return luminance;
}

void SkyWeights::set(std::size_t sensor, const Row& row) {
  place_[sensor][0] = node_.size();
  for (std::size_t half = 0; half < kHalves; ++half) {
    node_.insert(node_.end(), row.node[half].begin(), row.node[half].end());
    weight_.insert(weight_.end(), row.weight_sr[half].begin(), row.weight_sr[half].end());
    place_[sensor][half + 1] = node_.size();
    for (const std::uint16_t node : row.node[half]) is_used_[node] = 1;
  }
}

std::array<double, SkyWeights::kHalves> SkyWeights::lux(std::size_t sensor,
                                                        std::span<const float> luminance) const {
  std::array<double, kHalves> lux{};
  for (std::size_t half = 0; half < kHalves; ++half) {
    float sum = 0.0F;
    for (std::size_t k = place_[sensor][half]; k < place_[sensor][half + 1]; ++k) {
      sum += weight_[k] * luminance[node_[k]];
    }
    lux[half] = static_cast<double>(sum);
  }
  return lux;
}

void add_range(const SkyRange& range, SampleRandom& random, std::size_t half,
               SkyWeights::Row& row) {
  const auto add_parts = [&](double low, double high, double longest) {
    if (!(low < high)) return;
    const int parts = std::max(1, static_cast<int>(std::ceil((high - low) / longest)));
    const double part = (high - low) / parts, away = 0.5 * part / std::sqrt(3.0);
    for (int k = 0; k < 2 * parts; ++k) {
      const double altitude = low + (k / 2 + 0.5) * part + (k % 2 == 0 ? -away : away);
      const double level = std::cos(altitude);
      const double across = level * (range.toward * level + range.up * std::sin(altitude));
      row.node[half].push_back(SkyGrid::node_near(range.azimuth_rad, altitude, random));
      row.weight_sr[half].push_back(static_cast<float>(0.5 * part * range.width_rad * across));
    }
  };
  add_parts(range.low_rad, std::min(range.high_rad, kLow), kLongestLow);
  add_parts(std::max(range.low_rad, kLow), range.high_rad, kLongestHigh);
}

}  // namespace tenku
