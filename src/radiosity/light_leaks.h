/// Gaps through which light leaves a room.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/finding.h"
#include "illuminance/sensor.h"
#include "meshing/element_mesh.h"

namespace tenku {

/// A gap between surfaces.
struct LightLeak {
  Vec3 place;  ///< its middle, local frame
  double length_m = 0.0, width_m = 0.0;
  double share = 0.0;  ///< of the light that the surfaces seen from send
};

/// Looks for gaps from points in mostly closed rooms.
///
/// Rays that meet nothing beside rays that do pass an edge where the neighbours meet a surface.
/// Edges near each other are one opening; one that is wide both ways is taken for a window.
///
/// Valid    gaps that a few of kRays rays from some of kMostPoints points find: about 1 cm in a
///          room. A gap wider than kWidest of the longest side of the mesh is a window.
/// @param points  on the surface, not lifted
/// @param light   [point], what it sends, in any unit; points without are not looked from
std::vector<LightLeak> find_light_leaks(const ElementMesh& mesh, const Sensors& points,
                                        std::span<const double> light, double lift_m,
                                        std::uint64_t seed);

/// One finding on all of them, with the place of the worst.
void tell_light_leaks(const std::vector<LightLeak>& leaks, std::vector<Finding>& findings);

}  // namespace tenku
