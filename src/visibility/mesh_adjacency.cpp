#include "visibility/mesh_adjacency.h"

#include <algorithm>
#include <array>
#include <bit>
#include <compare>

#include "core/mixed_key_sort.h"
#include "core/random.h"

namespace tenku {
namespace {

/// A half-edge under the key of its undirected edge.
struct EdgeUse {
  std::uint64_t key;
  std::uint32_t half_edge;

  auto operator<=>(const EdgeUse&) const = default;
};

std::uint64_t position_hash(Vec3 p, std::uint32_t object) {
  // Adding zero makes the two zeros one.
  std::uint64_t h = mix_bits(std::bit_cast<std::uint64_t>(p.x + 0.0) + object);
  h = mix_bits(h ^ std::bit_cast<std::uint64_t>(p.y + 0.0));
  return mix_bits(h ^ std::bit_cast<std::uint64_t>(p.z + 0.0));
}

std::vector<EdgeUse> edge_uses(const TriangleSoup& soup) {
  std::vector<EdgeUse> uses(3 * soup.size());
  constexpr std::size_t kGrain = 4096;
  parallel_for(soup.size(), kGrain, [&](IndexRange range) {
    for (std::size_t t = range.begin; t < range.end; ++t) {
      std::array<std::uint64_t, 3> corner;
      for (unsigned k = 0; k < 3; ++k) {
        corner[k] = position_hash(soup.vertices[soup.triangles[t][k]], soup.object[t]);
      }
      for (unsigned e = 0; e < 3; ++e) {
        const std::uint64_t a = corner[e], b = corner[(e + 1) % 3];
        const auto half_edge = static_cast<std::uint32_t>(3 * t + e);
        uses[half_edge] = {mix_bits(std::min(a, b)) ^ std::max(a, b), half_edge};
      }
    }
  });
  return uses;
}

}  // namespace

MeshAdjacency::MeshAdjacency(const TriangleSoup& soup) : opposite_(3 * soup.size(), kNone) {
  std::vector<EdgeUse> uses = edge_uses(soup);
  sort_by_mixed_key(uses);
  for (std::size_t i = 0; i + 1 < uses.size(); ++i) {
    if (uses[i].key != uses[i + 1].key) continue;
    opposite_[uses[i].half_edge] = uses[i + 1].half_edge;
    opposite_[uses[i + 1].half_edge] = uses[i].half_edge;
    ++i;
  }
}

}  // namespace tenku
