/// Sizes that edges of the input shorter than the size force on what is beside them.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "meshing/bubble_face.h"

namespace tenku {

/// The ends of pieces that are clearly shorter than the size there, from which sizes rise by
/// `kRiseFromShort`.
///
/// Threads  immutable after construction; may be shared.
class ShortPieces {
 public:
  /// @param face  pieces and fixed bubbles
  explicit ShortPieces(const BubbleFace& face);

  bool empty() const { return ends_.empty(); }
  /// The size at `p` where `size_m` is wanted.
  double limited(PlanePoint p, double size_m) const;

 private:
  struct End {
    PlanePoint at;
    double size_m;
  };
  std::vector<End> ends_;
  BubbleGrid grid_;  ///< of the discs in which ends matter
};

}  // namespace tenku
