/// What must be true of any mesh, and surfaces put together by hand.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "meshing/mesh_surfaces.h"

namespace tenku::testing_support {

/// Polygons as fans of triangles, the first corner of each the middle of the fan.
class Surface {
 public:
  TriangleSoup soup;
  std::vector<Material> materials{Material{}, Material{}};
  std::uint32_t material = 0, object = 0;

  void fan(const std::vector<Vec3>& corners) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), corners.begin(), corners.end());
    for (std::uint32_t k = 1; k + 1 < corners.size(); ++k) {
      soup.triangles.push_back({first, first + k, first + k + 1});
      soup.material.push_back(material);
      soup.object.push_back(object);
      soup.surface_type.push_back(SurfaceType::Unknown);
    }
  }
  /// Level rectangle, facing up.
  void level(double x0, double y0, double x1, double y1, double z = 0.0) {
    fan({{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}});
  }
  void add(const Surface& other) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const Vec3& p : other.soup.vertices) soup.vertices.push_back(p);
    for (std::size_t t = 0; t < other.soup.size(); ++t) {
      const auto& [a, b, c] = other.soup.triangles[t];
      soup.triangles.push_back({first + a, first + b, first + c});
      soup.material.push_back(other.soup.material[t]);
      soup.object.push_back(other.soup.object[t]);
      soup.surface_type.push_back(other.soup.surface_type[t]);
    }
  }
  ElementMesh mesh(double element_m, double patch_m = 0.0) const {
    return mesh_surfaces(soup, materials, {.element_m = element_m, .patch_m = patch_m});
  }
};

inline double area_of(const ElementMesh& mesh) {
  double sum = 0.0;
  for (std::size_t e = 0; e < mesh.size(); ++e) sum += mesh.area_m2(e);
  return sum;
}

/// Smallest angle of all elements, degrees.
inline double least_angle_deg(const ElementMesh& mesh) {
  double least = 180.0;
  for (const auto& t : mesh.elements) {
    for (unsigned k = 0; k < 3; ++k) {
      const Vec3 p = mesh.vertices[t[k]];
      const Angle angle =
          angle_between(mesh.vertices[t[(k + 1) % 3]] - p, mesh.vertices[t[(k + 2) % 3]] - p);
      least = std::min(least, angle.in_degrees());
    }
  }
  return least;
}

inline double longest_edge(const ElementMesh& mesh) {
  double longest = 0.0;
  for (const auto& t : mesh.elements) {
    for (unsigned k = 0; k < 3; ++k) {
      longest = std::max(longest, length(mesh.vertices[t[(k + 1) % 3]] - mesh.vertices[t[k]]));
    }
  }
  return longest;
}

/// How the elements hang together by the vertices they share.
struct Topology {
  long vertices = 0, edges = 0, faces = 0;
  long border_edges = 0;   ///< of one element
  long crowded_edges = 0;  ///< of more than two
  double border_m = 0.0;

  /// Vertices less edges plus faces: the number of pieces less that of holes.
  long euler() const { return vertices - edges + faces; }
};

inline Topology topology_of(const ElementMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  std::set<std::uint32_t> vertices;
  for (const auto& t : mesh.elements) {
    vertices.insert(t.begin(), t.end());
    for (unsigned k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(t[k], t[(k + 1) % 3]);
      ++uses[{a, b}];
    }
  }
  Topology made;
  made.vertices = static_cast<long>(vertices.size());
  made.edges = static_cast<long>(uses.size());
  made.faces = static_cast<long>(mesh.size());
  for (const auto& [edge, n] : uses) {
    if (n > 2) ++made.crowded_edges;
    if (n != 1) continue;
    ++made.border_edges;
    made.border_m += length(mesh.vertices[edge.first] - mesh.vertices[edge.second]);
  }
  return made;
}

}  // namespace tenku::testing_support
