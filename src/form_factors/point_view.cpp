#include "form_factors/point_view.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/random.h"

namespace tenku {

std::uint64_t key_of(Vec3 position, Vec3 normal, std::uint64_t seed) {
  std::uint64_t key = mix_bits(seed);
  for (const double x : {position.x, position.y, position.z, normal.x, normal.y, normal.z}) {
    key = mix_bits(key + std::bit_cast<std::uint64_t>(x + 0.0));  // + 0.0: no negative zero
  }
  return key;
}

PointAxes::PointAxes(Vec3 normal, std::uint64_t key) : z(normal) {
  const double turn = 2.0 * kPi * SampleRandom(key, 0, 0).uniform();
  const auto [t, b] = tangent_frame(normal);
  x = std::cos(turn) * t + std::sin(turn) * b;
  y = cross(z, x);
}

PointView::PointView(const ElementMesh& mesh, Vec3 position, const PointAxes& axes) {
  vertex.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) {
    const Vec3 d = v - position;
    vertex.push_back({dot(d, axes.x), dot(d, axes.y), dot(d, axes.z)});
  }
  constexpr double kEdgeOn = 1e-12;  // sine of the angle between the line of sight and the plane
  for (std::uint32_t e = 0; e < mesh.size(); ++e) {
    const auto& [i, j, k] = mesh.elements[e];
    const Vec3 a = vertex[i], b = vertex[j], c = vertex[k];
    if (std::max({a.z, b.z, c.z}) <= 0.0) continue;
    const Vec3 normal = cross(b - a, c - a);
    const double offset = dot(normal, a);
    if (!(offset * offset > kEdgeOn * kEdgeOn * dot(normal, normal) * dot(a, a))) continue;
    seen.push_back({2 * e + (offset > 0.0 ? 1U : 0U), (1.0 / offset) * normal});
  }
}

ConvexPolygon PointView::polygon(const ElementMesh& mesh, const SeenSide& seen_side) const {
  const auto& [i, j, k] = mesh.elements[seen_side.side / 2];
  const ConvexPolygon whole(vertex[i], vertex[j], vertex[k]);
  if (std::min({vertex[i].z, vertex[j].z, vertex[k].z}) >= 0.0) return whole;
  return cut(whole, [](Vec3 p) { return p.z; });
}

FormFactorRow row_of(const PointView& view, const std::vector<double>& covered, double unit) {
  FormFactorRow row;
  for (std::size_t s = 0; s < covered.size(); ++s) {
    if (covered[s] > 0.0) {
      row.push_back({view.seen[s].side, static_cast<float>(covered[s] * unit)});
    }
  }
  return row;
}

}  // namespace tenku
