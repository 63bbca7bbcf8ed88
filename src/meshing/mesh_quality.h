/// How well a mesh is shaped and sized.
#pragma once

#include <functional>

#include "meshing/bubble_mesh.h"

namespace tenku {

/// Angles of a mesh's elements, and lengths of its edges against the size at their middle.
MeshQuality mesh_quality(const FlatPolygon& polygon, const PolygonMesh& mesh,
                         const std::function<double(PlanePoint)>& size_at);

}  // namespace tenku
