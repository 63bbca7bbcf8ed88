/// Results on sensors as fields for ParaView.
#pragma once

#include "illuminance/sensor.h"
#include "illuminance/sensor_grid.h"
#include "output/field_writer.h"
#include "study/lit_scene.h"

namespace tenku {

/// Point arrays `sun_lux`, `sky_lux`, `reflected_lux`, `total_lux`, `error_lux`, `sky_view`; cell
/// arrays `surface_type`, `object_id` with their names; field data `crs`, `origin`, `sky`.
FieldMesh field_of_grid(const LitScene& lit, const SensorGrid& grid,
                        const SensorIlluminance& values);

/// The same for sensors without a mesh: a cloud of points.
FieldMesh field_of_points(const LitScene& lit, const Sensors& sensors,
                          const SensorIlluminance& values);

}  // namespace tenku
