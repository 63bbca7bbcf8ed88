/// Reflected light of many sensors from that of a few.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "illuminance/sensor.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// Sensors that share reflected light, which varies slowly over a surface.
///
/// Sensors in one plane are grouped by cubes of a grid; the first of each group stands for it.
/// The others take the mean of the representatives around that they can see, weighted by
/// nearness.
///
/// Error    measured, not assumed: each representative is also predicted from those around it, and
///          the root mean square of what that misses, apart for flat and steep surfaces, goes into
///          the interval of every sensor that was not calculated itself.
class ReflectedSharing {
 public:
  ReflectedSharing(const Sensors& sensors, double distance_m);

  /// The sensors to calculate, by index.
  const std::vector<std::size_t>& representatives() const { return representative_; }

  /// Fills `all.reflected_lux` and adds to `all.error_lux`, from the results of the
  /// representatives in their order.
  void spread(const SensorIlluminance& of_representatives, const RayVisibility& rays,
              SensorIlluminance& all) const;

 private:
  struct Cell {
    std::uint64_t plane;
    std::int64_t i, j, k;
  };
  struct Blend {
    double lux = 0.0, error_lux = 0.0, weight = 0.0;
  };
  Cell cell_of(std::size_t sensor) const;
  bool is_flat(std::size_t sensor) const;
  double missed_lux(bool flat, const SensorIlluminance& of_representatives,
                    const RayVisibility& rays) const;
  static std::uint64_t key_of(const Cell& cell);
  Blend blend_at(std::size_t sensor, bool without_itself, const SensorIlluminance& results,
                 const RayVisibility& rays) const;

  const Sensors& sensors_;
  double distance_m_;
  std::vector<std::size_t> representative_;
  std::unordered_map<std::uint64_t, std::size_t> place_;  ///< cell -> index into representative_
};

}  // namespace tenku
