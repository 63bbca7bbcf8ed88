/// Small meshes for the tests of form factors.
#pragma once

#include <vector>

#include "meshing/element_mesh.h"

namespace tenku {

/// Adds a convex polygon as a fan of elements and one patch; material and object are its number.
inline void add_polygon(ElementMesh& mesh, const std::vector<Vec3>& ring) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto number = static_cast<std::uint32_t>(mesh.patches());
  mesh.vertices.insert(mesh.vertices.end(), ring.begin(), ring.end());
  for (std::uint32_t k = 2; k < ring.size(); ++k) {
    mesh.elements.push_back({first, first + k - 1, first + k});
    mesh.material.push_back(number);
    mesh.object.push_back(number);
  }
  mesh.patch_begin.push_back(static_cast<std::uint32_t>(mesh.size()));
}

/// The inside of a box from the origin to `size`, six patches whose fronts face inward, each cut
/// into `cells` by `cells` quadrilaterals of two elements.
inline ElementMesh box_mesh(Vec3 size, int cells) {
  ElementMesh mesh;
  const auto add_face = [&](Vec3 corner, Vec3 u, Vec3 v) {
    for (int j = 0; j < cells; ++j) {
      for (int i = 0; i < cells; ++i) {
        const Vec3 at = corner + (1.0 * i / cells) * u + (1.0 * j / cells) * v;
        const Vec3 du = (1.0 / cells) * u, dv = (1.0 / cells) * v;
        add_polygon(mesh, {at, at + du, at + du + dv, at + dv});
        if (i + j > 0) mesh.patch_begin.erase(mesh.patch_begin.end() - 2);
      }
    }
  };
  const Vec3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
  add_face({}, x, y);
  add_face(z, y, x);
  add_face({}, y, z);
  add_face(x, z, y);
  add_face({}, z, x);
  add_face(y, x, z);
  return mesh;
}

}  // namespace tenku
