/// The elements as the ray engine takes them.
#pragma once

#include "meshing/element_mesh.h"
#include "scene/triangle_soup.h"

namespace tenku {

/// One triangle an element, with the same number, all of material 0.
TriangleSoup soup_of(const ElementMesh& mesh);

}  // namespace tenku
