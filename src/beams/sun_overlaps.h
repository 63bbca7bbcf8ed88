/// Thrown polygons that overlap, added up.
#pragma once

#include <cstdint>
#include <vector>

#include "beams/sun_throw.h"

namespace tenku {

/// A flat convex polygon that gets the same reflected sunlight everywhere.
struct SunPatch {
  std::uint32_t triangle = 0;         ///< on which it lies
  std::vector<std::uint32_t> panels;  ///< that throw on it, ascending, each once
  std::uint32_t mirrors = 1;          ///< that the light has met, the most of any
  double lux = 0.0;                   ///< of all of them together
  double area_m2 = 0.0;
  double blur_m = 0.0;        ///< of the softest of its sources
  std::vector<Vec3> corners;  ///< counter-clockwise from the lit side
};

/// Divides the polygons so that none overlap, and adds up their lux where they did. Light on the
/// two sides of a sheet stays apart.
///
/// Error    sum of lux times area as before, but for pieces under 1e-10 m2.
/// Cost     in proportion to the pairs of polygons on one triangle.
std::vector<SunPatch> added_up(const TriangleSoup& soup,
                               const std::vector<ThrownPolygon>& polygons);

}  // namespace tenku
