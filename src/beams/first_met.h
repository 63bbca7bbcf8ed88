/// What a parallel beam meets first, exactly.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "beams/sun_outline.h"
#include "beams/triangle_tree.h"

namespace tenku {

/// A part of a beam that meets one triangle first, or nothing.
struct MetPiece {
  static constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();
  SunOutline outline;
  std::uint32_t triangle = kNothing;
};

/// A parallel beam at its beginning.
struct BeamStart {
  BeamFrame frame;
  SunOutline outline;  ///< convex
  DepthPlane plane;    ///< where it begins
  double cosine;       ///< between the plane's normal and the beam, positive
};

/// Divides a beam by what it meets first. The pieces do not overlap and leave nothing out.
///
/// The beam is cut by the outlines of the triangles and, where two of them overlap, by the line in
/// which their planes are equally deep: any arrangement is resolved, also triangles that pass
/// through one another or hide each other in a ring.
///
/// Error    pieces under 1e-10 m2 are left out. What lies within a millimetre of the beginning,
///          over the whole of the beam, is taken to be that same surface and is not met.
/// Cost     in proportion to the triangles in the beam times the pieces.
std::vector<MetPiece> first_met(const BeamStart& start, const TriangleTree& tree);

/// Unit normal of a triangle, its front side.
Vec3 normal_of(const TriangleSoup& soup, std::uint32_t triangle);

}  // namespace tenku
