/// Lines on surfaces where light stops: edges of shadows, and where things stand on a surface.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/vec3.h"
#include "meshing/bubble_mesh.h"
#include "meshing/flat_polygon.h"
#include "scene/material.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// Lines of one polygon, in its plane.
struct ShadowEdges {
  std::vector<ConstraintSegment> shadows;   ///< of umbrae, and outer ones of penumbrae
  std::vector<ConstraintSegment> contacts;  ///< edges of others that touch the polygon inside
};

/// Projects the edges of all polygons from the sun and from the corners of lamps onto every other
/// polygon, cuts what falls inside where such lines cross, and keeps the parts that part places
/// that see all, some and none of the lamp (by its corners and its middle), or the middle of the
/// sun or not. They are where light stops, and where it begins to fade: between, it fades evenly.
///
/// Source   of the lines: P. Heckbert, "Discontinuity meshing for radiosity", 1992: the edges
///          that corners of lamps and edges of casters make. Those of edges of lamps and
///          corners of casters, which are curved in general, are left out.
/// Cost     edges x polygons projections, and for each line that falls inside about 20 rays; a
///          polygon on which more than 2,000 lines fall gets none
/// @param rays  of the same surfaces
/// @param sun   unit, to its middle
/// @return      [polygon]
std::vector<ShadowEdges> shadow_edges(std::span<const FlatPolygon> polygons,
                                      std::span<const Material> materials,
                                      const RayVisibility& rays, const std::optional<Vec3>& sun);

}  // namespace tenku
