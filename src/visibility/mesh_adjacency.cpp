#include "visibility/mesh_adjacency.h"

#include <algorithm>
#include <array>
#include <bit>
#include <compare>

#include "core/mixed_key_sort.h"
#include "core/random.h"

namespace tenku {
namespace {

constexpr std::uint32_t kNone = MeshAdjacency::kNone;
constexpr std::size_t kBlock = 4096;  // triangles that are paired among themselves first
constexpr std::size_t kSlots = 4096;  // half-edges that wait for their opposites, a power of two

/// A half-edge under the key of its undirected edge.
struct EdgeUse {
  std::uint64_t key = 0;
  std::uint32_t half_edge = kNone;

  auto operator<=>(const EdgeUse&) const = default;
};

std::uint64_t position_hash(Vec3 p) {
  // Adding zero makes the two zeros one.
  std::uint64_t h = mix_bits(std::bit_cast<std::uint64_t>(p.x + 0.0));
  h = mix_bits(h ^ std::bit_cast<std::uint64_t>(p.y + 0.0));
  return mix_bits(h ^ std::bit_cast<std::uint64_t>(p.z + 0.0));
}

std::vector<std::uint64_t> position_hashes(const std::vector<Vec3>& vertices) {
  std::vector<std::uint64_t> hashes(vertices.size());
  parallel_for(vertices.size(), kBlock, [&](IndexRange range) {
    for (std::size_t v = range.begin; v < range.end; ++v) hashes[v] = position_hash(vertices[v]);
  });
  return hashes;
}

}  // namespace

MeshAdjacency::MeshAdjacency(const TriangleSoup& soup) : opposite_(3 * soup.size(), kNone) {
  const std::vector<std::uint64_t> hashes = position_hashes(soup.vertices);
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    opposite_[a] = b;
    opposite_[b] = a;
  };
  // Neighbours mostly lie near each other in the file: a table that stays in the cache finds them.
  const std::size_t blocks = (soup.size() + kBlock - 1) / kBlock;
  std::vector<std::vector<EdgeUse>> left_over(blocks);
  const auto pair_block = [&](std::size_t block) {
    std::vector<EdgeUse> waiting(kSlots);
    const std::size_t end = std::min(soup.size(), (block + 1) * kBlock);
    for (std::size_t t = block * kBlock; t < end; ++t) {
      std::array<std::uint64_t, 3> corner;
      for (unsigned k = 0; k < 3; ++k) corner[k] = hashes[soup.triangles[t][k]] + soup.object[t];
      for (unsigned e = 0; e < 3; ++e) {
        const auto [low, high] = std::minmax(corner[e], corner[(e + 1) % 3]);
        const EdgeUse use{mix_bits(low) ^ high, static_cast<std::uint32_t>(3 * t + e)};
        EdgeUse& slot = waiting[use.key % kSlots];
        if (slot.half_edge != kNone && slot.key == use.key) {
          join(slot.half_edge, use.half_edge);
          slot = {};
          continue;
        }
        if (slot.half_edge != kNone) left_over[block].push_back(slot);
        slot = use;
      }
    }
    std::copy_if(waiting.begin(), waiting.end(), std::back_inserter(left_over[block]),
                 [](const EdgeUse& use) { return use.half_edge != kNone; });
  };
  parallel_for(blocks, 1, [&](IndexRange range) {
    for (std::size_t block = range.begin; block < range.end; ++block) pair_block(block);
  });
  std::vector<EdgeUse> uses;
  for (const auto& rest : left_over) uses.insert(uses.end(), rest.begin(), rest.end());
  const auto join_alike = [&] {
    sort_by_mixed_key(uses);
    for (std::size_t i = 0; i + 1 < uses.size(); ++i) {
      if (uses[i].key != uses[i + 1].key) continue;
      join(uses[i].half_edge, uses[i + 1].half_edge);
      ++i;
    }
  };
  join_alike();
  // What is left lies on borders of objects: those of one material may go on in another object.
  uses.clear();
  for (std::uint32_t half_edge = 0; half_edge < opposite_.size(); ++half_edge) {
    if (opposite_[half_edge] != kNone) continue;
    const std::uint32_t t = half_edge / 3, e = half_edge % 3;
    const auto& corners = soup.triangles[t];
    const auto [low, high] = std::minmax(hashes[corners[e]], hashes[corners[(e + 1) % 3]]);
    uses.push_back({mix_bits(mix_bits(low) ^ high) + soup.material[t], half_edge});
  }
  join_alike();
}

}  // namespace tenku
