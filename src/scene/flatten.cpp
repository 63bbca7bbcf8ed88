#include "scene/flatten.h"

#include "scene/triangulation.h"

namespace tenku {

TriangleSoup flatten(const Scene& scene) {
  const Surfaces& surfaces = scene.surfaces;
  TriangleSoup soup;
  soup.vertices = scene.vertices;
  soup.triangles.reserve(surfaces.size());
  soup.object.reserve(surfaces.size());
  soup.surface_type.reserve(surfaces.size());
  soup.material.reserve(surfaces.size());
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    triangulate_polygon(surfaces, s, soup.vertices, soup.triangles);
    soup.object.resize(soup.size(), surfaces.object[s]);
    soup.surface_type.resize(soup.size(), surfaces.type[s]);
    soup.material.resize(soup.size(), surfaces.material[s]);
  }
  return soup;
}

std::vector<std::uint32_t> surfaces_of_triangles(const Scene& scene) {
  std::vector<Vec3> vertices = scene.vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> surfaces;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    triangles.clear();
    triangulate_polygon(scene.surfaces, s, vertices, triangles);
    surfaces.resize(surfaces.size() + triangles.size(), s);
  }
  return surfaces;
}

}  // namespace tenku
