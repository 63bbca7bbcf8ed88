/// Polygons of a scene as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace tenku {

/// What is unusual about a polygon.
struct PolygonShape {
  double off_plane_m = 0.0;     ///< largest distance of a vertex from the mean plane
  bool is_simple = true;        ///< no ring cuts or touches itself
  bool has_stray_hole = false;  ///< one that leaves its outer ring, or lies in another, by 1 cm
};
PolygonShape shape_of(const Scene& scene, std::size_t surface);

/// Triangles of one polygon, by index into `Scene::vertices`; counter-clockwise as its outer ring.
///
/// A constrained Delaunay triangulation in the polygon's mean plane (CGAL, exact predicates),
/// filled by the odd-even rule. Where rings cut each other the crossing becomes a vertex, appended
/// to `vertices`.
void triangulate_polygon(const Surfaces& surfaces, std::size_t surface, std::vector<Vec3>& vertices,
                         std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace tenku
