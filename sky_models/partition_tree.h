/// The tree of equal-area halves of the sky, and the patches of Tregenza and Reinhart.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "sky_models/element_moments.h"

namespace tenku {

/// The two halves of a cell of equal area, divided across its longer side.
std::pair<SkyCell, SkyCell> halves(const SkyCell& cell);

/// Binary tree over the vault. The moments of its upper levels are sums of those of the lower, so
/// that the sky is integrated once.
class PartitionTree {
 public:
  struct Node {
    SkyCell cell;
    ElementMoments moments;
    std::size_t first_child = 0;  ///< the second follows it; 0: not divided yet
  };

  explicit PartitionTree(const SkyModel& sky);

  const Node& node(std::size_t index) const { return nodes_[index]; }
  /// Index of the first of the two children, made if need be.
  std::size_t divide(std::size_t index);

 private:
  void build(std::size_t index, int depth);
  std::size_t append_children(std::size_t index);

  const SkyModel& sky_;
  std::vector<Node> nodes_;
};

/// Cells of Tregenza's 145 patches (`m` 0), or of Reinhart's subdivision `m` of them.
///
/// Source   bands of 12 degrees and a cap (Tregenza); 7 m bands of 90 / (7 m + 1/2) degrees with m
///          times the counts, and a cap (Radiance `reinsrc`).
std::vector<SkyCell> banded_cells(int m);

}  // namespace tenku
