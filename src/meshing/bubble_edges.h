/// Bubbles on the corners and edges of polygons, shared by all that meet there.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "meshing/bubble_mesh.h"

namespace tenku {

// How much sizes may rise from a short edge of the input, metres per metre.
inline constexpr double kRiseFromShort = 0.35;

/// Rings of polygons as chains of bubbles.
struct EdgeBubbles {
  std::vector<Vec3> places;  ///< [bubble]
  /// [polygon][ring] bubbles in the order of the ring
  std::vector<std::vector<std::vector<std::uint32_t>>> rings;
  std::vector<std::optional<BubbleFlaw::Kind>> refusal;  ///< [polygon]
};

/// Parts the edges of polygons where corners of others lie on them, and puts bubbles along each
/// part so that, of the sizes of the polygons that share it, the least is met: as many as bring
/// their distances closest to it. Beside edges shorter than the size, sizes rise by
/// `kRiseFromShort`.
EdgeBubbles fill_edges(std::span<const FlatPolygon> polygons, const SizeAt& size_at,
                       const BubbleOptions& options);

/// Places along a line on which bubbles touch: fractions of its length, in rising order, without
/// the ends.
/// @param size_at  [0, length] -> size
/// @param most     places; where more are needed, or the size is not positive, there is no answer
struct ChainAnswer {
  std::vector<double> at;
  std::optional<BubbleFlaw::Kind> refusal;
};
ChainAnswer bubble_chain(double length_m, const std::function<double(double)>& size_at,
                         std::size_t most);

}  // namespace tenku
