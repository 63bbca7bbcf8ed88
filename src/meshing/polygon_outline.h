/// From the borders of triangles to the rings of the polygon that they make.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/vec3.h"
#include "meshing/flat_polygon.h"

namespace tenku {

/// A straight piece of a face's border, from vertex to vertex in the sense of the face.
struct Border {
  std::uint32_t from, to, face;

  std::pair<std::uint32_t, std::uint32_t> key() const {
    return {std::min(from, to), std::max(from, to)};
  }
};

/// Order of the undirected pieces, by their vertices.
bool comes_before(const Border& a, const Border& b);

/// Rings about a surface.
struct Outline {
  std::vector<std::vector<Vec3>> rings;
  int layers = 1;  ///< so many times the surface is there, everywhere
};

/// Rings of the pieces that have the surface on one side only: those that occur an odd number of
/// times or, where a surface is there several times, that many times more in one sense than in the
/// other. Vertices between which a ring runs straight within `weld_m` are left out.
/// @param borders  with the surface to their left
Outline outline(std::vector<Border> borders, std::span<const Vec3> vertices, double weld_m);

/// Lays origin and axes of a polygon that has its rings and its normal.
void set_frame(FlatPolygon& polygon);

}  // namespace tenku
