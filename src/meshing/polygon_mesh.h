/// One polygon divided into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "meshing/flat_polygon.h"

namespace tenku {

/// Triangles that fill a polygon, counter-clockwise from its front, with the vertices they share.
struct PolygonMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> elements;
  std::size_t per_cell = 1;  ///< so many elements that follow one another fill a rectangle
};

/// Regular right triangles over a polygon all of whose edges run along two directions at right
/// angles, which lines from all corners cut into rectangles.
/// @param element_m  the longest edge
/// @param apart_m    corners nearer to one line than this lie on it
/// @return           nothing for other polygons, and where a rectangle would be longer than four
///                   times its width though the polygon has holes or notches
std::optional<PolygonMesh> grid_mesh(const FlatPolygon& polygon, double element_m, double apart_m);

/// Triangles of any polygon: Delaunay triangulation between points that are spread evenly over
/// its edges and, in equilateral triangles, over its inside.
/// @param element_m  the longest edge
PolygonMesh delaunay_mesh(const FlatPolygon& polygon, double element_m);

}  // namespace tenku
