/// Points and directions in the one frame of the program.
#pragma once

#include <cmath>
#include <compare>

#include "core/units.h"

namespace tenku {

/// Point (metres) or direction (unit length).
///
/// Frame    x east, y north, z up, origin at the site.
struct Vec3 {
  double x = 0.0, y = 0.0, z = 0.0;

  friend constexpr bool operator==(Vec3, Vec3) = default;
  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(double k, Vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
  friend constexpr Vec3 operator*(Vec3 a, double k) { return k * a; }
};

inline constexpr Vec3 kZenith{0.0, 0.0, 1.0};

constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }

/// `a` scaled to length one; a vector of NaN if its length is zero.
inline Vec3 normalized(Vec3 a) { return (1.0 / length(a)) * a; }

inline bool is_unit(Vec3 a) { return std::abs(dot(a, a) - 1.0) < 1e-9; }

inline bool is_finite(Vec3 a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Angle between two vectors of any length, exact also near 0 and 180 degrees.
inline Angle angle_between(Vec3 a, Vec3 b) {
  return Angle::radians(std::atan2(length(cross(a, b)), dot(a, b)));
}

/// Unit vector from an azimuth, clockwise from north, and an altitude above the horizon.
inline Vec3 direction_from(Angle azimuth, Angle altitude) {
  const double cos_altitude = std::cos(altitude.in_radians());
  return {cos_altitude * std::sin(azimuth.in_radians()),
          cos_altitude * std::cos(azimuth.in_radians()), std::sin(altitude.in_radians())};
}

/// Azimuth clockwise from north, in [0, 360) degrees; 0 at the zenith and the nadir.
inline Angle azimuth_of(Vec3 direction) {
  const double azimuth = std::atan2(direction.x, direction.y);
  return Angle::radians(azimuth < 0.0 ? azimuth + 2.0 * kPi : azimuth);
}

/// Altitude above the horizon, -90 to 90 degrees.
inline Angle altitude_of(Vec3 direction) {
  return Angle::radians(std::atan2(direction.z, std::hypot(direction.x, direction.y)));
}

/// Two unit vectors that make a right-handed frame with the unit vector `normal`.
///
/// Source   T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
struct TangentFrame {
  Vec3 tangent, bitangent;
};
inline TangentFrame tangent_frame(Vec3 normal) {
  const double sign = std::copysign(1.0, normal.z);
  const double a = -1.0 / (sign + normal.z);
  const double b = normal.x * normal.y * a;
  return {{1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x},
          {b, sign + normal.y * normal.y * a, -normal.y}};
}

}  // namespace tenku
