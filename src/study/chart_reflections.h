/// The stage of a chart that compares ways to all light, reflections included.
#pragma once

#include <cstdint>
#include <vector>

#include "illuminance/sensor.h"
#include "study/lit_scene.h"
#include "study/speed_accuracy.h"

namespace tenku {

/// Adds settings of the stage `reflections`: `paths` at several tolerances, shared between
/// neighbours as `tenku illuminance` shares them, `bounces` by their number, and in rooms
/// `radiosity`. Held against paths of each sensor by itself. Kept by reference: scene, sensors.
void add_reflection_stage(const LitScene& lit, const Sensors& sensors, std::uint64_t seed,
                          std::vector<ChartSetting>& settings,
                          std::vector<ChartReference>& references);

}  // namespace tenku
