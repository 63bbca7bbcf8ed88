/// Light straight from lamps, for each sensor by itself.
#pragma once

#include <cstdint>

#include "core/progress.h"
#include "illuminance/error_budget.h"
#include "illuminance/sensor.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// Adds the light straight from lamps to the reflected light of sensors, and its 95 % interval to
/// `error_lux`: what paths leave out with `IlluminanceOptions::lamps_apart`. Shadows keep their
/// edges, since no sensor takes the value of another.
///
/// Rays look at points chosen by `LampSampler`, or, where lamps fill most of the view, along
/// directions by the cosine: 32 at first, up to 512 while the budget is not met.
///
/// Error    variance of the mean of eight independent scrambles, widened for its few degrees of
///          freedom. What hides a part of a lamp so small that no ray tells of it is not known.
/// @return  rays sent
/// @throws Cancelled
std::uint64_t add_lamp_light(const Sensors& sensors, const RayVisibility& rays,
                             const ErrorBudget& budget, std::uint64_t seed, Progress& progress,
                             SensorIlluminance& values);

}  // namespace tenku
