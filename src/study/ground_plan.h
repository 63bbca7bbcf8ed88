/// Sensors on the ground, in squares as a map shows them.
#pragma once

#include <optional>
#include <vector>

#include "illuminance/sensor.h"
#include "reports/plan_map.h"
#include "study/lit_scene.h"

namespace tenku {

/// Squares of the plan that lie on open ground, and the buildings around them.
struct GroundPlan {
  PlanGrid grid;                  ///< values not yet filled in: all NaN
  std::vector<std::size_t> cell;  ///< [sensor], which square
  Sensors sensors;                ///< facing up, where the ground lies under a square's middle
  std::vector<PlanFace> buildings;

  void fill(const SensorIlluminance& values);
};

/// The ground straight below a place, unless a building covers it.
std::optional<Vec3> ground_below(const LitScene& lit, Vec3 from);

/// @param spacing_m  side of a square; wider where there would be over 60,000 of them
GroundPlan ground_plan(const LitScene& lit, double spacing_m);

}  // namespace tenku
