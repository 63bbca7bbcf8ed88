#include "meshing/mesh_soup.h"

namespace tenku {

TriangleSoup soup_of(const ElementMesh& mesh) {
  return {.vertices = mesh.vertices,
          .triangles = mesh.elements,
          .object = mesh.object,
          .surface_type = std::vector<SurfaceType>(mesh.size(), SurfaceType::Unknown),
          .material = std::vector<std::uint32_t>(mesh.size(), 0)};
}

}  // namespace tenku
