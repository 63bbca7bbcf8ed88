/// Bubbles put where there is room.
#pragma once

#include <cstddef>

#include "meshing/bubble_face.h"

namespace tenku {

/// Puts bubbles into a face that may have some, none of which moves while this lives.
class BubblePlacer {
 public:
  explicit BubblePlacer(BubbleFace& face, std::size_t expected);

  /// Fills the face from its pieces inwards: beside each piece, and then beside each bubble that
  /// was added, where bubbles that touch would be. Their order is that of the corners of
  /// equilateral triangles as far as sizes allow.
  /// @param most  no more bubbles than this
  void fill(std::size_t most);

  /// Adds a bubble at `to`, if it is clear of bubbles and of pieces, and no piece is between it and
  /// `from`.
  /// @param clear  least distance from another bubble, in mean sizes
  bool add_if_free(PlanePoint from, PlanePoint to, double clear);

 private:
  struct Front {
    PlanePoint at, along;  ///< unit vector in which it was reached
  };
  void add_beside(const BubblePiece& piece, bool is_left);
  void add_around(const Front& front);
  void advance(PlanePoint from, PlanePoint along);

  BubbleFace& face_;
  PieceMarks marks_;
  BubbleGrid grid_;
  PlanePoint low_, high_;
  std::vector<Front> fronts_;
};

}  // namespace tenku
