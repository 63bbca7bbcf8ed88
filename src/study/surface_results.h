/// Illuminance on the surfaces of a scene, for the files that users keep their models in.
#pragma once

#include <string>

#include "illuminance/sensor.h"
#include "illuminance/sensor_grid.h"
#include "study/lit_scene.h"

namespace tenku {

/// The scene as CityJSON 2.0 (scene/cityjson_writer.h) with the attributes `sun_lux`, `sky_lux`,
/// `reflected_lux`, `total_lux`, `error_lux` and `sky_view` on the surfaces that the grid covers,
/// and on their objects.
///
/// Each value is the mean over the area of the surface or object that has sensors; `error_lux` is
/// the mean of the sensors' half-widths, which the error of the mean does not exceed.
std::string cityjson_of_grid(const LitScene& lit, const SensorGrid& grid,
                             const SensorIlluminance& values);

/// The mesh of the grid as GLB with the total illuminance as vertex colours (viridis, from the low
/// to the high end of a round scale) and the values as the attributes `_TOTAL_LUX`, `_SKY_VIEW` and
/// so on. The scale, the reference system and the way back to the scene file are `extras` of the
/// asset.
///
/// Frame    glTF's: x east, y up, z south; metres about the local origin.
/// Error    32-bit floats.
/// Source   The Khronos Group, "glTF 2.0 Specification" (2021); extension KHR_materials_unlit.
std::string glb_of_grid(const LitScene& lit, const SensorGrid& grid,
                        const SensorIlluminance& values);

}  // namespace tenku
