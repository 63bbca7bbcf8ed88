/// Illuminance on surfaces as maps, for GIS programs.
#pragma once

#include "illuminance/sensor.h"
#include "illuminance/sensor_grid.h"
#include "output/map_writer.h"
#include "reports/plan_map.h"
#include "study/lit_scene.h"

namespace tenku {

/// What is seen of the grid from straight above, in squares: bands `sun_lux`, `sky_lux`,
/// `reflected_lux`, `total_lux`, `error_lux` and `sky_view` in the middle of each square, between
/// the sensors linear.
///
/// Frame    squares along true east and north, so turned a little in the map's reference system; a
///          scene in degrees has them in a transverse Mercator map of its own about the origin.
/// @param cell_m  side of a square; wider where there would be over 100 million of them
MapRaster raster_of_grid(const LitScene& lit, const SensorGrid& grid,
                         const SensorIlluminance& values, double cell_m);

/// The place of squares of a plan on the map, without bands. Frame as of `raster_of_grid`.
MapRaster raster_of_squares(const LitScene& lit, const PlanGrid& grid);

/// Layers `surfaces`, all on which there are sensors, and `buildings`: the objects to which they
/// belong, as their ground surfaces, or else their roofs, seen from above; each with the means of
/// study/surface_means.h.
std::vector<MapLayer> layers_of_grid(const LitScene& lit, const SensorGrid& grid,
                                     const SensorIlluminance& values);

/// The reference system of `layers_of_grid`; empty if the scene has none.
std::string map_crs(const LitScene& lit);

}  // namespace tenku
