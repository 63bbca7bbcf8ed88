/// Points with a normal that receive light: pixels, grid points and vertices are all sensors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/rgb.h"
#include "core/vec3.h"

namespace tenku {

/// Sensors, as a structure of arrays.
///
/// Frame    local east, north, up; normals are unit vectors.
/// Shape    both arrays [sensor].
struct Sensors {
  std::vector<Vec3> position;
  std::vector<Vec3> normal;

  std::size_t size() const { return position.size(); }
};

/// The chosen ones, in the order of `chosen`.
Sensors sensors_of(const Sensors& all, std::span<const std::uint32_t> chosen);

/// Moved off their surfaces along their normals, as engines want them.
Sensors lifted(Sensors sensors, double lift_m);

/// What the sensors receive.
///
/// Units    lux; `sky_view` dimensionless.
/// Shape    every array [sensor], in the order of the sensors.
/// Error    `error_lux` is the half-width of a 95 % interval about the total.
struct SensorIlluminance {
  std::vector<double> sun_lux, sky_lux, reflected_lux, error_lux;
  /// The reflected light in three channels, lux each: `reflected_lux` is its luminance.
  std::vector<Rgb> reflected_rgb;
  std::vector<double> sky_view;  ///< cosine-weighted visible fraction of the whole sky dome

  explicit SensorIlluminance(std::size_t sensors = 0)
      : sun_lux(sensors),
        sky_lux(sensors),
        reflected_lux(sensors),
        error_lux(sensors),
        reflected_rgb(sensors),
        sky_view(sensors) {}

  std::size_t size() const { return sun_lux.size(); }
  double total_lux(std::size_t i) const { return sun_lux[i] + sky_lux[i] + reflected_lux[i]; }
  /// Sun and sky are white.
  Rgb total_rgb(std::size_t i) const {
    return Rgb::grey(sun_lux[i] + sky_lux[i]) + reflected_rgb[i];
  }
  void set_reflected(std::size_t i, Rgb lux) {
    reflected_rgb[i] = lux;
    reflected_lux[i] = luminance_of(lux);
  }
  /// Mean of `error_lux`; 0 without sensors.
  double mean_error_lux() const;
};

}  // namespace tenku
