/// Between which elements nothing stands.
#pragma once

#include <cstdint>
#include <vector>

#include "meshing/element_mesh.h"

namespace tenku {

/// Tells pairs of elements that see the whole of each other, by planes that part everything else
/// from the space between them.
///
/// Threads  immutable after construction; may be shared.
/// Cost     memory of one byte a pair; time of all elements a question.
class Sightlines {
 public:
  /// Beyond this many elements the table would be too large.
  static constexpr std::size_t kMostElements = 4000;

  /// @param mesh  kept by reference, of `kMostElements` at most
  explicit Sightlines(const ElementMesh& mesh);

  /// Whether surely nothing stands between two elements. Where it is false, nothing may.
  bool are_clear(std::uint32_t a, std::uint32_t b) const;

  /// On which sides of the plane of `plane` an element lies: kFront, kBack, both, or, in the plane,
  /// neither.
  std::uint8_t sides(std::uint32_t plane, std::uint32_t element) const {
    return sides_[plane * mesh_.size() + element];
  }
  static constexpr std::uint8_t kFront = 1, kBack = 2;

 private:
  bool is_parted(std::uint32_t a, std::uint32_t b, std::uint32_t other) const;
  bool is_parted_by_edges(std::uint32_t a, std::uint32_t b, std::uint32_t other) const;
  Vec3 corner(std::uint32_t element, std::size_t k) const {
    return mesh_.vertices[mesh_.elements[element][k % 3]];
  }

  const ElementMesh& mesh_;
  double touching_m_;
  std::vector<std::uint8_t> sides_;  ///< [plane][element]
};

}  // namespace tenku
