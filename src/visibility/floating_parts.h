/// Parts of a scene below which sky may show: tree crowns, balconies, bridges.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/vec3.h"
#include "scene/triangle_soup.h"
#include "visibility/mesh_adjacency.h"

namespace tenku {

/// Triangles that hang together, and around them an upright cylinder.
struct FloatingPart {
  Vec3 middle;          ///< of the cylinder
  double radius = 0.0;  ///< level
  double lowest = 0.0, highest = 0.0;
  bool overhangs = false;  ///< reaches out beyond its feet: sky may show under it from any height
  std::uint32_t begin = 0, end = 0;  ///< of `FloatingParts::triangles`
};

/// Parts of the mesh that no walk along it finds from the ground: what a vertical slice cuts of
/// them may have sky below.
///
/// A part is what hangs together over the edges of one object. It may float if there is air
/// under its lowest points, if it reaches out beyond its feet and covers its plan twice (a crown
/// on a trunk does, a hill does not), or if what lies above its feet faces up and down alike (a
/// bridge does, a house does not). Parts of many triangles are left out.
///
/// Threads  immutable after construction; may be shared.
class FloatingParts {
 public:
  /// What a downward ray meets first.
  struct Below {
    std::uint32_t triangle;
    double distance_m;
  };
  using LookDown = std::function<std::optional<Below>(Vec3)>;

  FloatingParts() = default;
  /// @param is_opaque  [triangle]; others belong to no part
  FloatingParts(const TriangleSoup& soup, const MeshAdjacency& adjacency,
                const std::vector<bool>& is_opaque, const LookDown& look_down);

  bool empty() const { return parts_.empty(); }
  std::size_t size() const { return parts_.size(); }
  const FloatingPart& operator[](std::size_t i) const { return parts_[i]; }
  std::span<const std::uint32_t> triangles(const FloatingPart& part) const {
    return {triangle_.data() + part.begin, triangle_.data() + part.end};
  }
  /// Those below which sky may show from `origin`: the largest as seen from there, in no order.
  /// @param least_rad  half the angle that encloses a part, as seen from there
  void around(Vec3 origin, std::size_t most, double least_rad,
              std::vector<std::uint32_t>& found) const;

 private:
  /// Parts that lie beside each other.
  struct Cell {
    Vec3 middle;
    double radius = 0.0;   ///< from there to the farthest of their middles, level
    double largest = 0.0;  ///< of their radii
    /// Height below which one of them may show sky under it.
    double seen_below = -std::numeric_limits<double>::infinity();
    std::uint32_t begin = 0, end = 0;  ///< of the parts
  };
  void put_in_cells();

  std::vector<FloatingPart> parts_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> triangle_;
};

}  // namespace tenku
