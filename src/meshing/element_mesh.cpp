#include "meshing/element_mesh.h"

namespace tenku {

Vec3 ElementMesh::doubled_area(std::size_t element) const {
  const auto& [a, b, c] = elements[element];
  return cross(vertices[b] - vertices[a], vertices[c] - vertices[a]);
}

double ElementMesh::patch_area_m2(std::size_t patch) const {
  double sum = 0.0;
  for (std::size_t e = patch_begin[patch]; e < patch_begin[patch + 1]; ++e) sum += area_m2(e);
  return sum;
}

Vec3 ElementMesh::centre(std::size_t element) const {
  const auto& [a, b, c] = elements[element];
  return (1.0 / 3.0) * (vertices[a] + vertices[b] + vertices[c]);
}

double ElementMesh::mean_edge_m(std::size_t element) const {
  const auto& [a, b, c] = elements[element];
  return (length(vertices[b] - vertices[a]) + length(vertices[c] - vertices[b]) +
          length(vertices[a] - vertices[c])) /
         3.0;
}

Vec3 ElementMesh::normal(std::size_t side) const {
  const Vec3 front = normalized(doubled_area(side / 2));
  return side % 2 == 0 ? front : -front;
}

}  // namespace tenku
