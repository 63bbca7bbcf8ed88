/// Illuminance of sensors as means over what they stand on.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "illuminance/sensor.h"
#include "illuminance/sensor_grid.h"
#include "scene/scene.h"

namespace tenku {

inline constexpr std::size_t kLuxValues = 6;
inline constexpr std::array<const char*, kLuxValues> kLuxNames{
    "sun_lux", "sky_lux", "reflected_lux", "total_lux", "error_lux", "sky_view"};
using LuxValues = std::array<double, kLuxValues>;

LuxValues lux_values(const SensorIlluminance& values, std::size_t sensor);

/// Means over the area of each surface and object that has sensors, NaN where there are none.
/// `error_lux` is the mean of the sensors' half-widths, which the error of the mean does not
/// exceed.
struct SurfaceMeans {
  std::vector<LuxValues> of_surfaces;  ///< [surface]
  std::vector<LuxValues> of_objects;   ///< [object]
};
SurfaceMeans surface_means(const Scene& scene, const SensorGrid& grid,
                           const SensorIlluminance& values);

}  // namespace tenku
