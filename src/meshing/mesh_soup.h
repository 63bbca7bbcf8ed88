/// The elements as the ray engine takes them.
#pragma once

#include <span>
#include <vector>

#include "meshing/element_mesh.h"
#include "scene/material.h"
#include "scene/triangle_soup.h"

namespace tenku {

/// Triangles and what tells glass among them.
struct MeshSoup {
  TriangleSoup soup;
  std::vector<Material> materials;
};

/// One triangle an element, with the same number, all of material 0; then the panes.
MeshSoup soup_of(const ElementMesh& mesh);

/// The panes of a scene that have something of it on either side of their plane: no others can be
/// between two surfaces.
MeshPanes panes_of(const TriangleSoup& soup, std::span<const Material> materials);

}  // namespace tenku
