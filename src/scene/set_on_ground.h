/// Buildings and the ground that they stand on.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "scene/ground_heights.h"
#include "scene/raw_scene.h"

namespace tenku {

/// Height of the ground, m, local; none where there is no ground.
using GroundUnder = std::function<std::optional<double>(double x, double y)>;

/// Lets the buildings that stand above the ground reach down to it. Feet are the lowest vertices of
/// each; those of bridges are not lowered.
struct LoweredFeet {
  std::size_t buildings = 0;
  double farthest_m = 0.0;
};
LoweredFeet lower_feet(RawScene& raw, const GroundUnder& ground);

/// Sets buildings on terrain. `OnTerrain::Auto` moves them where all stand at one height, which is
/// no height of a terrain with hills; those that are not moved reach down to it. What has to float
/// or is buried is told as in `check_on_ground`.
///
/// Findings `set_on_terrain`, `feet_lowered`, `off_terrain`.
void set_on_ground(RawScene& raw, const GroundHeights& ground, OnTerrain how);

/// Tells the buildings all of whose feet are above the terrain (`floating_building`) or all of
/// which lies below it (`buried_building`). Parts count with the building that they belong to.
void check_on_ground(RawScene& raw, const GroundHeights& ground);

}  // namespace tenku
