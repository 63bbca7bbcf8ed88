/// Reflected light of many sensors from that of a few.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "illuminance/sensor.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// Where sensors lie to each other, as far as they share reflected light.
struct SharingLayout {
  std::vector<Vec3> place;             ///< [sensor], in cells of a grid
  std::vector<std::uint64_t> surface;  ///< [sensor]; those of one surface share
  int reach = 1;                       ///< cells on either side that are blended
  bool must_see = true;                ///< whether those that a wall parts share nothing
  bool is_measured = true;             ///< whether the error of sharing is measured
};

/// Equal for surfaces that face about the same way: what shares where a cell holds many surfaces.
std::uint64_t facing(Vec3 normal);

/// Sensors in one plane, in cubes with sides of `distance_m`; in wide ones those that face one way.
SharingLayout sharing_by_distance(const Sensors& sensors, double distance_m);

/// Sensors that share reflected light, which varies slowly over a surface.
///
/// The first sensor of each surface in each cell stands for it. The others take the mean of the
/// representatives around, weighted by nearness.
///
/// Error    measured, not assumed: each representative is also predicted from those around it. The
///          mean square of what that misses, less the variances of both, apart for flat and steep
///          surfaces, goes into the interval of every sensor that was not calculated itself. Where
///          it is not measured, the blend has the mean interval of what it is blended from, as if
///          that were not independent.
class ReflectedSharing {
 public:
  /// @param sensors  kept by reference: they must outlive this object
  ReflectedSharing(const Sensors& sensors, SharingLayout layout);

  const Sensors& sensors() const { return sensors_; }
  /// The sensors to calculate, by index.
  const std::vector<std::size_t>& representatives() const { return representative_; }

  /// Fills `all.reflected_lux` and adds to `all.error_lux`, from the results of the
  /// representatives in their order.
  void spread(const SensorIlluminance& of_representatives, const RayVisibility& rays,
              SensorIlluminance& all) const;

 private:
  struct Blend {
    double lux = 0.0, error_lux = 0.0, weight = 0.0;
  };
  std::uint64_t cell_key(std::size_t sensor, Vec3 steps_away) const;
  bool is_flat(std::size_t sensor) const;
  bool is_seen(std::size_t sensor, std::size_t other, const RayVisibility& rays) const;
  double missed_lux(bool flat, const SensorIlluminance& of_representatives,
                    const RayVisibility& rays) const;
  Blend blend_at(std::size_t sensor, bool without_itself, const SensorIlluminance& results,
                 const RayVisibility& rays) const;

  const Sensors& sensors_;
  SharingLayout layout_;
  std::vector<Vec3> steps_;  ///< to the cells that are blended
  std::vector<std::size_t> representative_;
  std::unordered_map<std::uint64_t, std::size_t> place_;  ///< cell -> index into representative_
};

}  // namespace tenku
