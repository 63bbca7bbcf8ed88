/// Affine maps of space, as scene graphs compose them.
#pragma once

#include <array>

#include "core/vec3.h"

namespace tenku {

/// p -> x * columns[0] + y * columns[1] + z * columns[2] + translation.
struct Affine {
  std::array<Vec3, 3> columns{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vec3 translation{};

  Vec3 linear(Vec3 p) const { return p.x * columns[0] + p.y * columns[1] + p.z * columns[2]; }
  Vec3 operator()(Vec3 p) const { return linear(p) + translation; }
  double determinant() const { return dot(cross(columns[0], columns[1]), columns[2]); }

  /// First `inner`, then `outer`.
  friend Affine operator*(const Affine& outer, const Affine& inner) {
    return {{outer.linear(inner.columns[0]), outer.linear(inner.columns[1]),
             outer.linear(inner.columns[2])},
            outer(inner.translation)};
  }

  static Affine moved(Vec3 by) { return {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, by}; }
};

/// glTF's axes (y up) to x east, y north, z up: (x, y, z) -> (x, -z, y).
inline constexpr Affine kYUpToZUp{{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}, {0, 0, 0}};

}  // namespace tenku
