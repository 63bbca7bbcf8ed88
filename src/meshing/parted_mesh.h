/// A mesh that comes apart along lines.
#pragma once

#include <span>

#include "meshing/bubble_mesh.h"
#include "meshing/polygon_mesh.h"

namespace tenku {

/// The same elements, but those on both sides of a line have vertices of their own there, at the
/// same places, so that what is known at vertices may jump. Where a line ends inside of the polygon
/// its end stays one.
/// @param mesh   conforming, with edges that follow the lines
/// @param lines  in the plane of the polygon
PolygonMesh parted_along(const FlatPolygon& polygon, PolygonMesh mesh,
                         std::span<const ConstraintSegment> lines);

}  // namespace tenku
