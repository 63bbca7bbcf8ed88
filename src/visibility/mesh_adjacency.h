/// Which triangle lies across which edge.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "scene/triangle_soup.h"

namespace tenku {

/// Neighbours of triangles across their edges: of one object, and where an object ends those of the
/// same material in others, so that a thing may be given in one piece or face by face.
///
/// Edge `e` of a triangle runs from its vertex `e` to its vertex `(e + 1) % 3`. Vertices at the
/// same place count as one. Where more than two triangles of an object meet in an edge, they are
/// paired with those nearest in the file.
///
/// Threads  immutable after construction; may be shared.
class MeshAdjacency {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  explicit MeshAdjacency(const TriangleSoup& soup);

  /// `3 * triangle + edge` of the same edge in the neighbour, or `kNone` at a border.
  std::uint32_t opposite(std::uint32_t triangle, unsigned edge) const {
    return opposite_[3 * static_cast<std::size_t>(triangle) + edge];
  }

 private:
  std::vector<std::uint32_t> opposite_;
};

}  // namespace tenku
