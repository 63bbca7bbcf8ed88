/// Points that can be asked for by where they are.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vec3.h"

namespace tenku {

/// A k-d tree over points that are kept by reference.
///
/// Threads  immutable after construction; may be shared.
/// Cost     n log n to build; a question about log n and as much as the answer.
class PointTree {
 public:
  explicit PointTree(std::span<const Vec3> points);

  /// Points within `reach_m` of the segment from `a` to `b`, by index, in rising order.
  std::vector<std::uint32_t> near_segment(Vec3 a, Vec3 b, double reach_m) const;

 private:
  void build(std::size_t begin, std::size_t end);

  std::span<const Vec3> points_;
  std::vector<std::uint32_t> order_;
  /// Where the range with that middle is parted.
  struct Cut {
    double at = 0.0;
    std::uint8_t axis = 0;
  };
  std::vector<Cut> cuts_;
};

/// The first of the points that lie within `reach_m` of each one: itself, if none is before it.
std::vector<std::uint32_t> welded(std::span<const Vec3> points, double reach_m);

/// Distance of `p` from the segment from `a` to `b`.
double distance_to_segment(Vec3 p, Vec3 a, Vec3 b);

}  // namespace tenku
