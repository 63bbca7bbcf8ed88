#include "core/closest_point.h"

#include <algorithm>

namespace tenku {

Vec3 closest_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const auto on_segment = [&](Vec3 s, Vec3 e) {
    const Vec3 d = e - s;
    const double squared = dot(d, d);
    const double t = squared > 0.0 ? std::clamp(dot(p - s, d) / squared, 0.0, 1.0) : 0.0;
    return s + t * d;
  };
  const Vec3 n = cross(b - a, c - a);
  const double area = dot(n, n);
  if (area > 0.0) {
    const double u = dot(cross(c - b, p - b), n) / area, v = dot(cross(a - c, p - c), n) / area;
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0) return u * a + v * b + (1.0 - u - v) * c;
  }
  Vec3 best = on_segment(a, b);
  for (const Vec3 other : {on_segment(b, c), on_segment(c, a)}) {
    if (length(other - p) < length(best - p)) best = other;
  }
  return best;
}

}  // namespace tenku
