/// Triangles between the bubbles of a face, and what they tell of how well bubbles lie.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "meshing/bubble_face.h"

namespace tenku {

/// A triangulation of a face's bubbles.
struct BubbleTriangles {
  struct Triangle {
    std::array<std::uint32_t, 3> corner;  ///< bubbles, counter-clockwise
    std::array<bool, 3> is_piece;         ///< the edge opposite to the corner
  };
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> is_used;  ///< [bubble] whether it is a corner of any
};

/// Constrained Delaunay triangulation; nothing if pieces cross.
std::optional<BubbleTriangles> triangulate(const BubbleFace& face);

/// Takes out bubbles that are not in any triangle, crowd one another or lie too near to a piece,
/// and puts in others in the middle of triangles that are too wide.
/// @return  number of bubbles taken out and put in
std::size_t correct_population(BubbleFace& face, const BubbleTriangles& mesh);

}  // namespace tenku
