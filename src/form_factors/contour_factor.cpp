#include "form_factors/contour_factor.h"

#include <array>
#include <cmath>

#include "core/error.h"

namespace tenku {
namespace {

/// The part of the polygon on or above the plane z = 0 of heights given beside it.
struct Clipped {
  std::array<Vec3, kMostContourCorners + 1> corner;
  std::size_t count = 0;
};

Clipped above(Vec3 point, Vec3 normal, std::span<const Vec3> polygon) {
  Clipped clipped;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i] - point, b = polygon[(i + 1) % polygon.size()] - point;
    const double za = dot(a, normal), zb = dot(b, normal);
    if (za >= 0.0) clipped.corner[clipped.count++] = a;
    if ((za > 0.0 && zb < 0.0) || (za < 0.0 && zb > 0.0)) {
      clipped.corner[clipped.count++] = a + (za / (za - zb)) * (b - a);
    }
  }
  return clipped;
}

/// What one edge adds to twice pi times the form factor.
double part_of_edge(Vec3 a, Vec3 b, Vec3 normal) {
  const Vec3 across = cross(a, b);
  const double size = length(across);
  return size > 0.0 ? std::atan2(size, dot(a, b)) / size * dot(across, normal) : 0.0;
}

}  // namespace

double contour_factor_of_edges(Vec3 point, Vec3 normal,
                               std::span<const std::array<Vec3, 2>> edges) {
  double sum = 0.0;
  for (const auto& [a, b] : edges) sum += part_of_edge(a - point, b - point, normal);
  return std::abs(sum) / (2.0 * kPi);
}

double contour_factor(Vec3 point, Vec3 normal, std::span<const Vec3> polygon) {
  expects(polygon.size() <= kMostContourCorners, "a polygon of few corners");
  const Clipped clipped = above(point, normal, polygon);
  double sum = 0.0;
  for (std::size_t i = 0; i < clipped.count; ++i) {
    sum += part_of_edge(clipped.corner[i], clipped.corner[(i + 1) % clipped.count], normal);
  }
  return std::abs(sum) / (2.0 * kPi);
}

}  // namespace tenku
