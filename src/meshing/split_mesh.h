/// Triangles of one polygon that are split into four, again and again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "meshing/polygon_mesh.h"

namespace tenku {

/// A mesh that grows finer where it is told to, and conforms.
///
/// A triangle is split into four by the middles of its edges. One whose neighbour across an edge is
/// two steps finer, or all of whose neighbours are finer, is split as well; one with one or two
/// finer neighbours is shown as two or three, which are one triangle again when it is asked to
/// split: angles do not get worse from one time to the next.
///
/// Source   R. E. Bank, A. H. Sherman and A. Weiser, "Some refinement algorithms and data
/// structures
///          for regular local mesh refinement", 1983.
class SplitMesh {
 public:
  /// @param mesh  conforming
  explicit SplitMesh(const PolygonMesh& mesh);

  /// Splits what elements of `conforming()` stand for.
  /// @param is_wanted  [element of the last `conforming()`]
  void split(std::span<const std::uint8_t> is_wanted);

  /// The mesh as it is now.
  const PolygonMesh& conforming() const { return shown_; }

 private:
  using Triangle = std::array<std::uint32_t, 3>;
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::uint32_t middle(std::uint32_t a, std::uint32_t b);
  /// The middle of an edge, or kNowhere if it is whole.
  std::uint32_t middle_if_any(std::uint32_t a, std::uint32_t b) const;
  bool must_split(const Triangle& t) const;
  void split_in_four(std::size_t triangle);
  void show();
  void show(const Triangle& t);

  static constexpr std::uint32_t kNowhere = ~0U;
  std::vector<Triangle> triangle_;
  std::map<Edge, std::uint32_t> middle_;
  PolygonMesh shown_;
  std::vector<std::uint32_t> triangle_of_;  ///< [shown element]
};

}  // namespace tenku
