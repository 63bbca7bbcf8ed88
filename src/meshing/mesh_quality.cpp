#include "meshing/mesh_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace tenku {

MeshQuality mesh_quality(const FlatPolygon& polygon, const PolygonMesh& mesh,
                         const std::function<double(PlanePoint)>& size_at) {
  MeshQuality quality;
  if (mesh.elements.empty()) return quality;
  quality.least_angle_deg = 180.0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : mesh.elements) {
    double smallest = 180.0;
    for (unsigned k = 0; k < 3; ++k) {
      const Vec3 p = mesh.vertices[t[k]];
      const Vec3 a = mesh.vertices[t[(k + 1) % 3]] - p, b = mesh.vertices[t[(k + 2) % 3]] - p;
      smallest = std::min(smallest, angle_between(a, b).in_degrees());
      edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
    }
    quality.mean_smallest_angle_deg += smallest;
    quality.least_angle_deg = std::min(quality.least_angle_deg, smallest);
  }
  quality.mean_smallest_angle_deg /= static_cast<double>(mesh.elements.size());
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::size_t close = 0;
  for (const auto& [v, w] : edges) {
    const Vec3 a = mesh.vertices[v], b = mesh.vertices[w];
    const double size = size_at(polygon.flat(0.5 * (a + b)));
    constexpr double kClose = 0.2;
    if (std::abs(length(b - a) - size) <= kClose * size) ++close;
  }
  quality.edges = edges.size();
  quality.share_within_20_pct =
      100.0 * static_cast<double>(close) / static_cast<double>(edges.size());
  return quality;
}

}  // namespace tenku
