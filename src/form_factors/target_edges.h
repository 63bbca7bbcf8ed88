/// Outlines of what form factors are asked to, and how near they come.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "meshing/element_mesh.h"

namespace tenku {

/// Number of the form factor that a side counts in.
using Column = std::uint32_t;
inline constexpr Column kNoColumn = std::numeric_limits<Column>::max();

/// The edges of elements beyond which no other element of the same plane and columns goes on.
///
/// Threads  immutable after construction; may be shared.
class TargetEdges {
 public:
  /// @param mesh, column  kept by reference; `column` [side]
  TargetEdges(const ElementMesh& mesh, const std::vector<Column>& column);

  /// Doubt about one column.
  struct Doubt {
    Column column;
    double value;
    Vec3 across;  ///< unit: from the part toward the edge, in the plane of the part
  };

  /// What the mean over a convex part of a surface may be wrong by, because of edges that it comes
  /// nearer to than `ratio` times its extent: something may rise there from nothing to all within a
  /// strip as narrow as the edge is near or, where it touches, as its element is narrow, between
  /// points of the part.
  /// @param side    whose plane the part lies in
  /// @param wanted  [side]
  std::vector<Doubt> doubts(std::span<const Vec3> part, std::uint32_t side, double ratio,
                            const std::vector<char>& wanted) const;

 private:
  const ElementMesh& mesh_;
  const std::vector<Column>& column_;
  std::vector<std::uint8_t> outline_;   ///< [element], bit k: of the edge from corner k to the next
  std::vector<Vec3> centre_;            ///< [element]
  std::vector<double> radius_, width_;  ///< [element]
};

}  // namespace tenku
