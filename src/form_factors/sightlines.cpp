#include "form_factors/sightlines.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace tenku {
namespace {

/// Least and greatest height of the corners of an element over a plane.
struct Heights {
  double low, high;
};

}  // namespace

Sightlines::Sightlines(const ElementMesh& mesh) : mesh_(mesh), sides_(mesh.size() * mesh.size()) {
  expects(mesh.size() <= kMostElements, "the table of sight lines is small");
  double extent = 0.0;
  for (const Vec3& v : mesh.vertices) extent = std::max(extent, length(v - mesh.vertices[0]));
  touching_m_ = 1e-11 * extent;
  for (std::uint32_t plane = 0; plane < mesh.size(); ++plane) {
    const Vec3 normal = mesh.normal(2 * plane), at = corner(plane, 0);
    for (std::uint32_t e = 0; e < mesh.size(); ++e) {
      std::uint8_t sides = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double height = dot(corner(e, k) - at, normal);
        if (height > touching_m_) sides |= kFront;
        if (height < -touching_m_) sides |= kBack;
      }
      sides_[plane * mesh.size() + e] = sides;
    }
  }
}

bool Sightlines::are_clear(std::uint32_t a, std::uint32_t b) const {
  for (std::uint32_t other = 0; other < mesh_.size(); ++other) {
    const bool crossed = (sides(other, a) | sides(other, b)) == (kFront | kBack);
    if (crossed && other != a && other != b && !is_parted(a, b, other)) return false;
  }
  return true;
}

bool Sightlines::is_parted(std::uint32_t a, std::uint32_t b, std::uint32_t other) const {
  return (sides(a, other) & sides(a, b)) == 0 || (sides(b, other) & sides(b, a)) == 0 ||
         is_parted_by_edges(a, b, other) || is_parted_by_edges(b, a, other);
}

/// Whether a plane through an edge of `a` and a corner of `b` has both on one side and `other` on
/// the other.
bool Sightlines::is_parted_by_edges(std::uint32_t a, std::uint32_t b, std::uint32_t other) const {
  for (std::size_t edge = 0; edge < 3; ++edge) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 at = corner(a, edge);
      const Vec3 normal = normalized(cross(corner(a, edge + 1) - at, corner(b, k) - at));
      if (!is_finite(normal)) continue;
      const auto heights = [&](std::uint32_t e) {
        const auto [low, high] =
            std::minmax({dot(corner(e, 0) - at, normal), dot(corner(e, 1) - at, normal),
                         dot(corner(e, 2) - at, normal)});
        return Heights{low, high};
      };
      const Heights of_a = heights(a), of_b = heights(b), of_other = heights(other);
      const double low = std::min(of_a.low, of_b.low), high = std::max(of_a.high, of_b.high);
      const bool above = low >= -touching_m_ && of_other.high <= touching_m_;
      const bool below = high <= touching_m_ && of_other.low >= -touching_m_;
      if (above || below) return true;
    }
  }
  return false;
}

}  // namespace tenku
