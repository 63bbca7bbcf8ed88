/// Reflected light of many sensors from that of a few.
#pragma once

#include <cstdint>
#include <vector>

#include "illuminance/sensor.h"
#include "illuminance/sensor_cells.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// Where sensors lie to each other, as far as they share reflected light.
struct SharingLayout {
  std::vector<Vec3> place;             ///< [sensor], in cells of a grid
  std::vector<std::uint64_t> surface;  ///< [sensor]; those of one surface share
  /// [sensor], of the sky: those that see much more of it than others share nothing with them, nor
  /// do those that see none with those that see some. Empty: not told apart.
  std::vector<double> sky_view;
  int reach = 1;            ///< cells on either side that are blended
  bool must_see = true;     ///< whether those that a wall parts share nothing
  bool is_measured = true;  ///< whether the error of sharing is measured
};

/// Equal for surfaces that face about the same way: what shares where a cell holds many surfaces.
std::uint64_t facing(Vec3 normal);

/// Sensors in one plane, in cubes with sides of `distance_m`; in wide ones those that face one way.
/// @param sky_view  [sensor]
SharingLayout sharing_by_distance(const Sensors& sensors, const std::vector<double>& sky_view,
                                  double distance_m);

/// Sensors that share reflected light, which varies slowly over a surface.
///
/// Sensors stand for those of their surface and cell that are like them and in their sight; one
/// that nobody stands for stands for itself. The others take the mean of the representatives
/// around that are like them and in sight, weighted by nearness.
///
/// Error    measured, not assumed: pilots, drawn evenly from the sensors that share, are calculated
///          too. What a pilot's blend misses, by the scale of its blend (the intervals of what is
///          blended, how far that disagrees, and a part of its mean), is sorted; the value below
///          which 95 % of these ratios lie, times the scale of another sensor, is its interval
///          (split conformal prediction, see `Pilots`), apart for flat and steep surfaces. Sensors
///          that see no sky are not drawn, since most of them are buried and certain.
///          Where it is not measured, the blend has the mean interval of what it is blended from,
///          as if that were not independent.
class ReflectedSharing {
 public:
  /// @param sensors, rays  kept by reference: they must outlive this object
  ReflectedSharing(const Sensors& sensors, SharingLayout layout, const RayVisibility& rays);

  const Sensors& sensors() const { return sensors_; }
  /// The sensors to calculate, by index: representatives, then pilots.
  const std::vector<std::uint32_t>& calculated() const { return calculated_; }

  /// Fills `all.reflected_lux` and `all.reflected_rgb`, and adds to `all.error_lux`, from the
  /// results of the calculated sensors in their order.
  void spread(const SensorIlluminance& of_calculated, SensorIlluminance& all) const;

 private:
  struct Blend {
    double lux = 0.0, error_lux = 0.0, scale_lux = 0.0;
    Rgb rgb{};
  };
  void choose_representatives();
  void draw_pilots();
  bool is_like(std::size_t sensor, std::size_t other) const;
  bool is_seen(std::size_t sensor, std::size_t other) const;
  bool has_representative(std::size_t sensor) const;
  double interval_per_scale(bool flat, const SensorIlluminance& of_calculated) const;
  /// @param around  places among those calculated, of the cells around it
  Blend blend_at(std::size_t sensor, const std::vector<std::uint32_t>& around,
                 const SensorIlluminance& of_calculated) const;

  const Sensors& sensors_;
  const RayVisibility& rays_;
  SharingLayout layout_;
  SensorCells cells_;  ///< hold places among those calculated
  std::vector<std::uint32_t> calculated_;
  std::size_t representatives_ = 0;  ///< the first of those calculated
  std::vector<std::uint32_t> own_;   ///< [sensor], place among those calculated, or none
};

}  // namespace tenku
