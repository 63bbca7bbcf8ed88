/// A tree of boxes that finds the faces a beam may meet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "beams/beam_view.h"

namespace tenku {

/// Upright box.
struct FaceBox {
  Vec3 low, high;

  static FaceBox around(std::span<const Vec3> points);
  void add(const FaceBox& other);
  /// Whether all of it is behind the plane.
  bool is_behind(const Plane& plane) const;
};

/// Boxes within boxes.
///
/// Threads  immutable after construction; may be shared.
class FaceTree {
 public:
  FaceTree() = default;
  explicit FaceTree(std::vector<FaceBox> boxes);

  /// The boxes that are not behind any one of the planes, in rising order: all that reach into the
  /// space before all of them, and maybe some more.
  /// @param planes  their normals of any length
  [[nodiscard]] std::vector<std::uint32_t> before(std::span<const Plane> planes) const;

 private:
  struct Node {
    FaceBox box;
    std::uint32_t begin, end;  ///< of `order_`
    std::uint32_t right;       ///< the left child follows its parent; 0: a leaf
  };

  void build(std::uint32_t begin, std::uint32_t end);

  std::vector<FaceBox> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace tenku
