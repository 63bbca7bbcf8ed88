/// Finds the triangles of a scene that reach into a convex part of space.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/extent.h"
#include "scene/triangle_soup.h"

namespace tenku {

/// Points with normal . p + offset >= 0.
struct HalfSpace {
  Vec3 normal;
  double offset;
};

/// Tree of boxes over the triangles of a soup.
///
/// Threads  immutable after construction; may be shared.
/// Cost     a second for a million triangles.
class TriangleTree {
 public:
  /// @param soup  kept by reference: it must outlive this object
  explicit TriangleTree(const TriangleSoup& soup);

  /// Puts into `found` all triangles that are not wholly outside one of the half-spaces, in no
  /// order that matters but always the same.
  void find(std::span<const HalfSpace> spaces, std::vector<std::uint32_t>& found) const;

  const TriangleSoup& soup() const { return soup_; }

 private:
  struct Node {
    Extent box;
    std::uint32_t first = 0, count = 0;  ///< triangles of a leaf; count 0: an inner node
    std::uint32_t right = 0;             ///< the left child follows its parent
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t last, const std::vector<Vec3>& middle);

  const TriangleSoup& soup_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace tenku
