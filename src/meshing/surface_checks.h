/// What a mesh shows of a scene that radiosity bears badly: told, not mended.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshing/element_mesh.h"
#include "meshing/flat_polygon.h"
#include "meshing/surface_flaw.h"

namespace tenku {

/// Flaws of polygons and of the mesh made of them:
///  - `Overlap`: elements whose centre lies on another polygon in the same plane;
///  - `Gap`: edges that stop between `weld_m` and 1 cm (or a 500th of the extent) before another
///    polygon, along three quarters of their length at least, so that light passes between;
///  - `Sliver`: polygons more than a hundred times as long as wide;
///  - `Coarse`: elements narrower than 32 steps of 32-bit floats at their place, in which rays are
///    traced.
/// @param polygon_of  [element]
/// Cost     1 us per element, 10 us per edge of a polygon, over the threads
std::vector<SurfaceFlaw> check_surfaces(const std::vector<FlatPolygon>& polygons,
                                        const ElementMesh& mesh,
                                        std::span<const std::uint32_t> polygon_of,
                                        const JoinTolerance& tolerance);

}  // namespace tenku
