/// How long the light of sensors is expected to take.
#pragma once

#include "illuminance/illuminate.h"
#include "illuminance/light_method.h"
#include "visibility/engines.h"

namespace tenku {

/// Options to which the reflected light of representatives is found (defined in illuminate.cpp).
IlluminanceOptions options_for_sharing(const IlluminanceOptions& options);

/// Seconds of clock time that `illuminate` is expected to take, from a plan and pilots.
///
/// Direct light as `plan_light` foretells it, with the time that the plan itself takes. Reflected
/// light by paths: that of a few sensors (`predicted_reflection_s`); where it is shared, runs of
/// neighbours, a twentieth of all, tell how many representatives there are. By radiosity: the
/// solution, for a few sensors. With a value to decide on: all of it for a few sensors.
///
/// Error    too much where reflected light rules, since later sensors find what earlier ones
/// stored:
///          up to 2.3 times (docs/benchmarks.md, "Time limits").
double expected_light_s(const Sensors& sensors, const Engines& engines,
                        const DaylightSource& source, const IlluminanceOptions& options,
                        const LightMethod& method);

}  // namespace tenku
