/// Elements that can be asked for by where they are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/extent.h"
#include "meshing/element_mesh.h"

namespace tenku {

/// A tree of boxes about the elements of a mesh that is kept by reference.
///
/// Threads  immutable after construction; may be shared.
/// Cost     n log n to build; a question about log n and as much as the answer.
class ElementTree {
 public:
  explicit ElementTree(const ElementMesh& mesh);

  struct Near {
    std::uint32_t element;
    double distance_m;
  };

  /// Calls `visit` with elements at most `reach_m` from `p`, in no order.
  /// @param visit  returns how far those may be that are still asked for; less than 0 for none
  template <class Visit>
  void for_each_near(Vec3 p, double reach_m, const Visit& visit) const {
    std::array<std::uint32_t, 64> stack;  // a tree of 2^64 elements is no deeper
    std::size_t depth = 0;
    if (!nodes_.empty()) stack[depth++] = 0;
    while (depth > 0) {
      const std::uint32_t at = stack[--depth];
      const Node& node = nodes_[at];
      if (!is_within(node.box, p, reach_m)) continue;
      if (node.second != 0) {
        stack[depth++] = node.second;
        stack[depth++] = at + 1;
        continue;
      }
      for (std::uint32_t i = node.begin; i < node.end; ++i) {
        const double distance = distance_m(p, order_[i]);
        if (distance <= reach_m) reach_m = visit(Near{order_[i], distance});
      }
    }
  }

 private:
  struct Node {
    Extent box;
    std::uint32_t begin, end;  ///< in `order_`
    std::uint32_t second = 0;  ///< of two parts; the first follows, none if 0
  };
  void build(std::uint32_t begin, std::uint32_t end);
  static bool is_within(const Extent& box, Vec3 p, double reach_m) {
    return p.x >= box.min.x - reach_m && p.x <= box.max.x + reach_m && p.y >= box.min.y - reach_m &&
           p.y <= box.max.y + reach_m && p.z >= box.min.z - reach_m && p.z <= box.max.z + reach_m;
  }
  double distance_m(Vec3 p, std::uint32_t element) const;

  const ElementMesh& mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace tenku
