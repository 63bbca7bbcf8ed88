/// Reflected sunlight on the ground, in squares as a map shows them.
#pragma once

#include "reports/plan_map.h"
#include "study/ground_plan.h"
#include "study/reflected_sun.h"

namespace tenku {

/// What reflected sunlight the ground under the middle of each square gets. NaN: no open ground; 0:
/// none.
struct SunPlan {
  PlanGrid minutes;   ///< that it gets any
  PlanGrid most_lux;  ///< of all panels together, at the strongest instant
  std::vector<PlanFace> buildings;
  double lit_m2 = 0.0;  ///< of squares that get any
};

/// @param spacing_m  side of a square; wider where there would be over 60,000 of them
/// @param sun        with overlaps added: patches of one instant do not overlap
SunPlan sun_plan(const LitScene& lit, const ReflectedSun& sun, double spacing_m);

}  // namespace tenku
