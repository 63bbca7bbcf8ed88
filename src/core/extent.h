/// Boxes about points.
#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "core/vec3.h"

namespace tenku {

/// Axis-parallel box; inside out until a point is added.
struct Extent {
  Vec3 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 max = -min;

  void add(Vec3 p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
  }
  Vec3 middle() const { return 0.5 * (min + max); }
  Vec3 size() const { return max - min; }
  double longest_side() const { return std::max({size().x, size().y, size().z}); }
};

/// Box about points.
inline Extent extent_of(std::span<const Vec3> points) {
  Extent box;
  for (const Vec3& p : points) box.add(p);
  return box;
}

}  // namespace tenku
