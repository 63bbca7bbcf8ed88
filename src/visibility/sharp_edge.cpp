#include "visibility/sharp_edge.h"

#include <cmath>
#include <cstdint>

namespace tenku {
namespace {

constexpr double kFlat = 1e-7;  // sine of the angle between faces of one plane

/// Whether the surface goes on across the edge as if it were not there.
bool is_flat(const SharpEdge& edge) {
  if (!edge.other) return false;
  const Vec3 along = edge.b - edge.a, from = edge.face - edge.a, to = *edge.other - edge.a;
  const Vec3 normal = cross(along, from), inward = cross(normal, along);
  const double off = dot(normal, to);
  return off * off < kFlat * kFlat * dot(normal, normal) * dot(to, to) && dot(inward, to) < 0.0;
}

}  // namespace

std::vector<SharpEdge> few_sharp_edges(const TriangleSoup& soup, const MeshAdjacency& adjacency,
                                       std::size_t most) {
  std::vector<SharpEdge> result;
  const auto corner = [&](std::size_t triangle, unsigned k) {
    return soup.vertices[soup.triangles[triangle][k % 3]];
  };
  for (std::uint32_t t = 0; t < soup.size(); ++t) {
    for (unsigned e = 0; e < 3; ++e) {
      SharpEdge edge{corner(t, e), corner(t, e + 1), corner(t, e + 2)};
      const std::uint32_t opposite = adjacency.opposite(t, e);
      if (opposite != MeshAdjacency::kNone) {
        if (opposite / 3 < t) continue;
        edge.other = corner(opposite / 3, opposite % 3 + 2);
      }
      if (is_flat(edge)) continue;
      if (result.size() == most) return {};
      result.push_back(edge);
    }
  }
  return result;
}

}  // namespace tenku
