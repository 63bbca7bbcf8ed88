/// Convex outlines across a parallel beam, and how they are cut.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "core/vec3.h"

namespace tenku {

/// Place across a beam, metres.
struct AcrossPoint {
  double x = 0.0, y = 0.0;
};

/// Convex polygon across a beam, counter-clockwise; fewer than three corners: nothing.
using SunOutline = std::vector<AcrossPoint>;

/// Coordinates across and along a parallel beam.
///
/// Frame    right-handed, about the local origin; `along` is the direction in which depth grows.
struct BeamFrame {
  Vec3 x_axis, y_axis, along;

  /// @param direction  unit
  explicit BeamFrame(Vec3 direction);

  AcrossPoint across(Vec3 p) const { return {dot(x_axis, p), dot(y_axis, p)}; }
  Vec3 point(AcrossPoint p, double depth) const {
    return p.x * x_axis + p.y * y_axis + depth * along;
  }
};

/// Depth of a plane at each place across a beam: linear.
struct DepthPlane {
  double at_origin = 0.0, slope_x = 0.0, slope_y = 0.0;

  /// The plane through `point` with the unit vector `normal`, which is not across the beam.
  DepthPlane(const BeamFrame& frame, Vec3 point, Vec3 normal);

  double depth(AcrossPoint p) const { return at_origin + slope_x * p.x + slope_y * p.y; }
};

/// Cosine to a beam below which a plane counts as seen edge-on: it gets and stops nothing. Its
/// illuminance would be a millionth of what a facing plane has.
inline constexpr double kEdgeOn = 1e-6;

/// Places with a x + b y + c >= 0.
struct HalfPlane {
  double a, b, c;

  double height(AcrossPoint p) const { return a * p.x + b * p.y + c; }

  /// On the left of the line from `from` to `to`; heights are distances in metres.
  static HalfPlane left_of(AcrossPoint from, AcrossPoint to);
  /// Where `near` is less deep than `far`; heights are differences of depth.
  static HalfPlane before(const DepthPlane& near, const DepthPlane& far) {
    return {far.slope_x - near.slope_x, far.slope_y - near.slope_y, far.at_origin - near.at_origin};
  }
};

/// The parts of an outline inside and outside a half-plane. Corners within a nanometre of the line
/// are on it.
///
/// Source  I. E. Sutherland and G. W. Hodgman, "Reentrant polygon clipping", CACM 17(1), 1974.
std::pair<SunOutline, SunOutline> split(const SunOutline& outline, const HalfPlane& half);

/// An outline cut along the edges of another.
struct CutOutline {
  SunOutline inside;                ///< what both share; empty: nothing
  std::vector<SunOutline> outside;  ///< the rest of the first, in convex pieces
};
CutOutline cut_by(const SunOutline& outline, const SunOutline& knife);

/// Area in m2; positive counter-clockwise.
double area_of(const SunOutline& outline);

/// The outline of a polygon seen along the beam, counter-clockwise whatever side it shows.
SunOutline outline_of(const BeamFrame& frame, const std::vector<Vec3>& corners);

/// Greatest of a linear function over an outline.
template <class Height>
double greatest(const SunOutline& outline, const Height& height) {
  double most = -1e300;
  for (const AcrossPoint& p : outline) most = std::fmax(most, height(p));
  return most;
}

}  // namespace tenku
