/// Bubbles that push and pull one another into place.
#pragma once

#include <cstddef>

#include "meshing/bubble_face.h"

namespace tenku {

/// Force between two bubbles, positive where they are pushed apart.
///
/// Source   K. Shimada, D. C. Gossard, "Bubble mesh: automated triangular meshing of non-manifold
///          geometry by sphere packing", ACM Solid Modeling 1995: the cubic that is zero at the
///          stable distance and at 1.5 of it, bounded and level at zero distance.
/// @param ratio  of their distance to the stable one, not negative
/// @return       per unit of stiffness; the slope at 1 is -1
constexpr double bubble_force(double ratio) {
  return ratio < 1.5 ? (1.25 * ratio - 2.375) * ratio * ratio + 1.125 : 0.0;
}

/// Moves the bubbles that are not fixed until the root mean square of a step, in sizes, is no more
/// than `motion`, but by no more than `steps_most` steps. None passes through a piece.
/// @return  steps made
std::size_t move_bubbles(BubbleFace& face, std::size_t steps_most, double motion);

}  // namespace tenku
