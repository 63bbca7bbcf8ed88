#include "form_factors/lambert_polygon.h"

#include <cmath>

namespace tenku {

double lambert_form_factor(const ConvexPolygon& polygon) {
  double sum = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 a = polygon[k], b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    const Vec3 normal = cross(a, b);
    const double sine = length(normal);
    if (sine > 0.0) sum += std::atan2(sine, dot(a, b)) * normal.z / sine;
  }
  return std::abs(sum) / (2.0 * kPi);
}

}  // namespace tenku
