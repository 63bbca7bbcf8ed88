#include "meshing/mesh_soup.h"

#include <algorithm>
#include <limits>

#include "core/extent.h"

namespace tenku {
namespace {

constexpr double kOnPlane = 1e-6;  // of the box's longest side

/// Whether a box reaches to both sides of a plane.
bool is_parted(const Extent& box, const std::array<Vec3, 3>& corner) {
  const Vec3 normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double x : {box.min.x, box.max.x}) {
    for (const double y : {box.min.y, box.max.y}) {
      for (const double z : {box.min.z, box.max.z}) {
        const double height = dot(normal, Vec3{x, y, z} - corner[0]);
        low = std::min(low, height), high = std::max(high, height);
      }
    }
  }
  const double nothing = kOnPlane * box.longest_side() * length(normal);
  return low < -nothing && high > nothing;
}

}  // namespace

MeshSoup soup_of(const ElementMesh& mesh) {
  MeshSoup made{{.vertices = mesh.vertices,
                 .triangles = mesh.elements,
                 .object = mesh.object,
                 .surface_type = std::vector<SurfaceType>(mesh.size(), SurfaceType::Unknown),
                 .material = std::vector<std::uint32_t>(mesh.size(), 0)},
                std::vector<Material>(1)};
  TriangleSoup& soup = made.soup;
  const MeshPanes& panes = mesh.panes;
  for (std::size_t k = 0; k < panes.corner.size(); ++k) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), panes.corner[k].begin(), panes.corner[k].end());
    soup.triangles.push_back({first, first + 1, first + 2});
    soup.object.push_back(0);
    soup.surface_type.push_back(SurfaceType::Unknown);
    soup.material.push_back(1 + panes.material[k]);
  }
  made.materials.insert(made.materials.end(), panes.materials.begin(), panes.materials.end());
  return made;
}

MeshPanes panes_of(const TriangleSoup& soup, std::span<const Material> materials) {
  MeshPanes panes;
  const Extent box = extent_of(soup.vertices);
  for (std::size_t t = 0; t < soup.size(); ++t) {
    if (!materials[soup.material[t]].is_glass()) continue;
    const auto& [a, b, c] = soup.triangles[t];
    const std::array<Vec3, 3> corner{soup.vertices[a], soup.vertices[b], soup.vertices[c]};
    if (!is_parted(box, corner)) continue;
    panes.corner.push_back(corner);
    panes.material.push_back(soup.material[t]);
  }
  if (!panes.empty()) panes.materials.assign(materials.begin(), materials.end());
  return panes;
}

}  // namespace tenku
