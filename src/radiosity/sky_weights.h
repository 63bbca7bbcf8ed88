/// How much each direction of the sky gives to sensors: rows of a sparse matrix.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "sky_models/sky_model.h"

namespace tenku {

/// Directions of the sky, a degree apart in azimuth and in altitude; the last row is the zenith.
struct SkyGrid {
  static constexpr std::uint32_t kColumns = 360, kRows = 91, kNodes = kColumns * kRows;

  /// One of the four nodes about a direction, each with the chance of its weight in a bilinear
  /// interpolation: on average, and over many directions, what that gives.
  static std::uint16_t node_near(double azimuth_rad, double altitude_rad, SampleRandom& random);

  /// Luminances at the nodes wanted, cd/m2 [node]; 0 at others.
  static std::vector<float> luminances(const SkyModel& sky,
                                       std::span<const std::uint8_t> is_wanted);
};

/// Illuminance of sensors as weighted sums of luminances at the nodes of a grid.
///
/// Each sensor has two halves, of slices beside one another, whose difference tells the error.
class SkyWeights {
 public:
  static constexpr std::size_t kHalves = 2;

  /// Of one sensor.
  struct Row {
    std::array<std::vector<std::uint16_t>, kHalves> node;
    std::array<std::vector<float>, kHalves> weight_sr;  ///< solid angle times cosine
  };

  explicit SkyWeights(std::size_t sensors) : place_(sensors), is_used_(SkyGrid::kNodes) {}

  /// Sets the row of a sensor, anew where it has one already.
  void set(std::size_t sensor, const Row& row);

  /// Nodes that any row has [node].
  std::span<const std::uint8_t> is_used() const { return is_used_; }

  /// Illuminance of both halves, lux.
  /// @param luminance  [node]
  std::array<double, kHalves> lux(std::size_t sensor, std::span<const float> luminance) const;

  std::size_t size() const { return node_.size(); }
  std::size_t bytes() const { return size() * (sizeof(std::uint16_t) + sizeof(float)); }

 private:
  /// Begin, middle and end of a row.
  using Place = std::array<std::size_t, kHalves + 1>;
  std::vector<Place> place_;  ///< [sensor]
  std::vector<std::uint16_t> node_;
  std::vector<float> weight_;
  std::vector<std::uint8_t> is_used_;  ///< [node]
};

/// A range of altitudes in a slice of the sky.
///
/// A surface with the component `toward` of its normal toward the azimuth and `up` upward receives
/// L cos(altitude) (toward cos(altitude) + up sin(altitude)) per radian of both angles.
struct SkyRange {
  double azimuth_rad, toward, up;
  double width_rad;  ///< of azimuth that the slice stands for, times the transmittance of panes
  double low_rad, high_rad;
};

/// Adds it to half of a row, as points of Gauss's rule.
void add_range(const SkyRange& range, SampleRandom& random, std::size_t half, SkyWeights::Row& row);

}  // namespace tenku
