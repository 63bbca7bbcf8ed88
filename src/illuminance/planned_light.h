/// Illuminance by the engine, and in the detail, that a plan chooses.
#pragma once

#include <cstdint>
#include <span>

#include "illuminance/light_plan.h"

namespace tenku {

/// As `illuminate` with rays, but direct light is found as `method` says. What came of the plan is
/// in `IlluminanceResult::regions`. Reflected light is always followed by rays.
///
/// Error    of regions lit by shadow maps `error_lux` comes from the pilots (see `Pilots`): what
///          elements, texels and left-out casters cost, whatever that is. With `Detail::Paper`
///          likewise.
/// Same bits for any number of threads, but with `EngineChoice::Auto` the choice itself depends on
/// how long things take.
/// @throws as `illuminate` and `plan_light`
IlluminanceResult illuminate(const Sensors& sensors, const Engines& engines,
                             const DaylightSource& source, const IlluminanceOptions& options,
                             const LightMethod& method, Progress& progress);

/// Puts the direct light of some sensors, and what it took, where it belongs among all.
/// @param places  of the sensors of `part` in `whole`
void take_direct(const IlluminanceResult& part, std::span<const std::uint32_t> places,
                 IlluminanceResult& whole);

/// Seconds that the reflected light of the sensors is expected to take, from that of a few: more
/// than it takes where later sensors find what earlier ones have stored.
double predicted_reflection_s(const Sensors& sensors, const RayVisibility& rays,
                              const DaylightSource& source, const IlluminanceOptions& options);

}  // namespace tenku
