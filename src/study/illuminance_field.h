/// Results on sensors as fields for ParaView.
#pragma once

#include <span>

#include "illuminance/decision.h"
#include "illuminance/sensor.h"
#include "illuminance/sensor_grid.h"
#include "output/field_writer.h"
#include "study/lit_scene.h"

namespace tenku {

/// Point arrays `sun_lux`, `sky_lux`, `reflected_lux`, `total_lux`, `error_lux`, `sky_view`, and
/// `decided` unless it is empty (1 yes, 0 no, -1 undecided); cell
/// arrays `surface_type`, `object_id` with their names; field data `crs`, `grid_convergence_deg`
/// (true azimuth of grid north, clockwise), `origin`, `to_file`, `sky`.
///
/// Frame    local east, north, up. In coordinates of the scene file a point is
///          origin + to_file * point, with `to_file` nine numbers, row by row: scale, turn and
///          order of axes in one. Files in degrees have none (FileFrame).
/// Error    of the way back: 32-bit points, 0.1 mm within 1 km of the origin.
FieldMesh field_of_grid(const LitScene& lit, const SensorGrid& grid,
                        const SensorIlluminance& values, std::span<const Decided> decided = {});

/// The same for sensors without a mesh: a cloud of points.
FieldMesh field_of_points(const LitScene& lit, const Sensors& sensors,
                          const SensorIlluminance& values, std::span<const Decided> decided = {});

/// Adds the texts that lead to the place and the light: `crs`, `origin`, `to_file`, `sky` and so
/// on.
void add_place(FieldMesh& mesh, const LitScene& lit);

}  // namespace tenku
