/// Which edges of elements follow lines on their polygons.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshing/bubble_mesh.h"
#include "meshing/element_mesh.h"
#include "meshing/flat_polygon.h"

namespace tenku {

/// @param polygon_of  [element]
/// @param lines       [polygon], or none at all
/// @return            [element], bit k: the edge from corner k on lies on a line; none without
/// lines
std::vector<std::uint8_t> edges_on_lines(const ElementMesh& mesh,
                                         std::span<const FlatPolygon> polygons,
                                         std::span<const std::uint32_t> polygon_of,
                                         std::span<const std::vector<ConstraintSegment>> lines);

}  // namespace tenku
