/// Direct light of many sensors, the skylight of most of them from that of those around.
#pragma once

#include <cstddef>

#include "core/progress.h"
#include "illuminance/daylight_source.h"
#include "illuminance/illuminate.h"
#include "illuminance/sensor.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// Rounds of ever finer cells, until these hold few sensors.
///
/// In each cell one of the sensors that are still open is calculated by rays. The skylight of the
/// others is the value, at their place, of the plane fitted by weighted least squares to those that
/// have been calculated around them, on the same surface and in their sight. Pilots, drawn evenly
/// from the open sensors, are calculated too. What the fits miss of them, by the scale of the fit
/// (how far its points lie off it, their own intervals, a part of their mean), tells up to which
/// scale fits may be trusted: as far as nineteen of twenty pilots with no more than that lie within
/// half of the tolerance. Their ratio is the interval by scale of the others (split conformal
/// prediction, see `Pilots`). Sensors that may be trusted are done; the others stay open. What is
/// open at the end is calculated. Sunlight has sharp edges and is calculated for each sensor.
///
/// @param options       `bounces` 0
/// @param interpolated  where it is to be told how many sensors were not calculated; may be null
/// @throws as `illuminate`
IlluminanceResult illuminate_sparsely(const Sensors& sensors, const RayVisibility& rays,
                                      const DaylightSource& source,
                                      const IlluminanceOptions& options, Progress& progress,
                                      std::size_t* interpolated = nullptr);

}  // namespace tenku
