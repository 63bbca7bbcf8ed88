/// A piece of the sky vault, bounded by two azimuths and two altitudes.
#pragma once

#include <vector>

#include "core/units.h"
#include "core/vec3.h"

namespace tenku {

/// Bounds of a piece of the vault. In azimuth and the sine of the altitude areas are true, so that
/// halves are halves and a uniform pair of numbers is a uniform direction.
///
/// Units    azimuth in radians, clockwise from north; may be negative or beyond a turn.
struct SkyCell {
  double azimuth_from = 0.0, azimuth_to = 2.0 * kPi;
  double sine_from = 0.0, sine_to = 1.0;  ///< of the altitude

  [[nodiscard]] double solid_angle() const {
    return (azimuth_to - azimuth_from) * (sine_to - sine_from);
  }

  /// Direction at fractions of the bounds; uniform over the cell for uniform `u` and `v` in [0, 1).
  [[nodiscard]] Vec3 direction(double u, double v) const;

  /// The point that halves the area both ways; the zenith for a cap around it.
  [[nodiscard]] Vec3 centre() const;

  /// Whether the cell goes all the way round the zenith.
  [[nodiscard]] bool is_cap() const;
};

/// Corners of the cell on the unit sphere, counter-clockwise seen from its centre's inside, with
/// points between them so that no edge spans more than `longest_edge`.
std::vector<Vec3> outline(const SkyCell& cell, Angle longest_edge = Angle::degrees(3.0));

/// One element of a partition of the sky: what it is, and what light it sends.
struct SkyElement {
  SkyCell cell;
  Vec3 direction;            ///< unit, to the cell's centre
  double solid_angle = 0.0;  ///< sr
  Luminance luminance;       ///< mean over the solid angle

  /// Integral of luminance times direction over the cell, lx. A plane with unit normal n that the
  /// whole cell can see receives exactly dot(n, illuminance_vector) from it, so any unobstructed
  /// horizontal plane receives the exact sum, whatever the number of elements.
  Vec3 illuminance_vector;

  /// Standard error of one random direction in the cell, lx, for the worst-oriented plane.
  double standard_error_lux = 0.0;
};

}  // namespace tenku
