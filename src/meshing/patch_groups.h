/// Elements of a polygon grouped into patches.
#pragma once

#include <cstddef>
#include <vector>

#include "meshing/polygon_mesh.h"

namespace tenku {

/// Reorders the elements of a polygon so that those of a patch follow one another.
///
/// Halves the polygon across its longer side until the box about each part, along the axes of the
/// polygon, has a diagonal of at most `patch_m`, or the part is one element (or cell); parts that
/// do not hang together by edges are parted.
/// @return number of elements of each patch
std::vector<std::size_t> group_patches(const FlatPolygon& polygon, PolygonMesh& mesh,
                                       double patch_m);

}  // namespace tenku
