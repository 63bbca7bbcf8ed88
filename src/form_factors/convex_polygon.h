/// Small flat polygons that are cut by planes.
#pragma once

#include <array>
#include <cstddef>

#include "core/error.h"
#include "core/vec3.h"

namespace tenku {

/// A convex polygon with few corners: a triangle cut by some planes.
class ConvexPolygon {
 public:
  static constexpr std::size_t kMaximum = 10;

  ConvexPolygon() = default;
  ConvexPolygon(Vec3 a, Vec3 b, Vec3 c) : size_(3), corner_{a, b, c} {}

  std::size_t size() const { return size_; }
  bool empty() const { return size_ < 3; }
  Vec3 operator[](std::size_t k) const { return corner_[k]; }
  const Vec3* begin() const { return corner_.data(); }
  const Vec3* end() const { return corner_.data() + size_; }
  void add(Vec3 corner) {
    expects(size_ < kMaximum, "a cut polygon has few corners");
    corner_[size_++] = corner;
  }

 private:
  std::size_t size_ = 0;
  std::array<Vec3, kMaximum> corner_;
};

/// The part where `height(corner)`, which is linear in space, is positive.
///
/// Source  I. E. Sutherland and G. W. Hodgman, "Reentrant polygon clipping", CACM 17(1), 1974.
template <class Height>
ConvexPolygon cut(const ConvexPolygon& polygon, const Height& height) {
  ConvexPolygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 a = polygon[k], b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    const double at_a = height(a), at_b = height(b);
    if (at_a >= 0.0) kept.add(a);
    if ((at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0)) {
      kept.add(a + at_a / (at_a - at_b) * (b - a));
    }
  }
  return kept.empty() ? ConvexPolygon{} : kept;
}

}  // namespace tenku
