/// Edges at which a surface ends or turns.
#pragma once

#include <optional>
#include <vector>

#include "core/vec3.h"
#include "scene/triangle_soup.h"
#include "visibility/mesh_adjacency.h"

namespace tenku {

/// An edge between two triangles that do not lie in one plane, or at the end of a surface: no
/// other bounds what is seen.
///
/// Frame    local east, north, up.
struct SharpEdge {
  Vec3 a, b;
  Vec3 face;                    ///< third corner of one triangle on it
  std::optional<Vec3> other{};  ///< of the other; none where the surface ends
};

/// All sharp edges; none if there are more than `most`.
std::vector<SharpEdge> few_sharp_edges(const TriangleSoup& soup, const MeshAdjacency& adjacency,
                                       std::size_t most);

}  // namespace tenku
