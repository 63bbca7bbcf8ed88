/// Altitudes kept with their sines and cosines, which cost more than the sums that need them.
#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>

namespace tenku {

/// Angle whose tangent is `slope`, radians; error below 2e-8.
///
/// Source   M. Abramowitz, I. Stegun, "Handbook of Mathematical Functions", 4.4.49.
inline double arctangent(double slope) {
  const double size = std::abs(slope);
  const bool steep = size > 1.0;
  const double t = steep ? 1.0 / size : size, u = t * t;
  double sum = 0.0028662257;
  for (const double coefficient : {-0.0161657367, 0.0429096138, -0.0752896400, 0.1065626393,
                                   -0.1420889944, 0.1999355085, -0.3333314528, 1.0}) {
    sum = sum * u + coefficient;
  }
  return std::copysign(steep ? std::numbers::pi / 2.0 - t * sum : t * sum, slope);
}

/// An angle above the horizon with its sine and cosine.
struct Altitude {
  double radians = 0.0, sine = 0.0, cosine = 1.0;

  static Altitude of(double radians) {
    if (radians == 0.0) return {};
    return {radians, std::sin(radians), std::cos(radians)};
  }
  static constexpr Altitude zenith() { return {std::numbers::pi / 2.0, 1.0, 0.0}; }
  /// From its tangent; the angle as `arctangent`, sine and cosine to rounding.
  static Altitude of_slope(double slope) {
    const double cosine = 1.0 / std::sqrt(1.0 + slope * slope);
    return {arctangent(slope), slope * cosine, cosine};
  }
  /// Further up by a signed angle.
  Altitude turned(double angle_rad) const {
    const double u = angle_rad * angle_rad;
    const bool is_small = u < 1e-6;
    const double s = is_small ? angle_rad * (1.0 - u / 6.0) : std::sin(angle_rad);
    const double c = is_small ? 1.0 - 0.5 * u * (1.0 - u / 12.0) : std::cos(angle_rad);
    return {radians + angle_rad, sine * c + cosine * s, cosine * c - sine * s};
  }
};

}  // namespace tenku
