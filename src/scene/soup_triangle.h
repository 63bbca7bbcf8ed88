/// One triangle of a soup: corners, middle, area.
#pragma once

#include <array>
#include <cstdint>

#include "core/vec3.h"
#include "scene/triangle_soup.h"

namespace tenku {

inline std::array<Vec3, 3> corners_of(const TriangleSoup& soup, std::uint32_t triangle) {
  const auto& [a, b, c] = soup.triangles[triangle];
  return {soup.vertices[a], soup.vertices[b], soup.vertices[c]};
}

inline Vec3 middle_of(const TriangleSoup& soup, std::uint32_t triangle) {
  const auto [a, b, c] = corners_of(soup, triangle);
  return (1.0 / 3.0) * (a + b + c);
}

inline double area_m2(const TriangleSoup& soup, std::uint32_t triangle) {
  const auto [a, b, c] = corners_of(soup, triangle);
  return 0.5 * length(cross(b - a, c - a));
}

}  // namespace tenku
