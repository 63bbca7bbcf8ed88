/// How a beam sees the scene: from a point or along a direction, directly or by way of mirrors.
#pragma once

#include "core/vec3.h"

namespace tenku {

/// Points whose height, `dot(normal, p) - offset`, is zero.
struct Plane {
  Vec3 normal;  ///< unit
  double offset = 0.0;

  double height(Vec3 p) const { return dot(normal, p) - offset; }
  Vec3 mirrored(Vec3 p) const { return p - 2.0 * height(p) * normal; }
  Vec3 mirrored_direction(Vec3 d) const { return d - 2.0 * dot(normal, d) * normal; }
};

/// Place in the window of all beams: the pixel for a camera, metres across the light for the sun.
struct WindowPoint {
  double u = 0.0, v = 0.0;
};

/// A point of space as a beam sees it: u = U / W, v = V / W where W is positive.
struct Homogeneous {
  double u = 0.0, v = 0.0, w = 1.0;
};

/// How near a plane is to the apex at each place of the window. Linear in u and v: for a point apex
/// one over the distance in units of the ray's direction, for a direction the distance's negative.
struct Nearness {
  double at_origin = 0.0, by_u = 0.0, by_v = 0.0;

  double at(WindowPoint p) const { return at_origin + by_u * p.u + by_v * p.v; }
  friend Nearness operator-(Nearness a, Nearness b) {
    return {a.at_origin - b.at_origin, a.by_u - b.by_u, a.by_v - b.by_v};
  }
};

/// A ray, its direction of any length.
struct BeamRay {
  Vec3 origin, direction;
};

/// A projective map between the places of a window and the rays from an apex.
///
/// The apex is homogeneous: a point, from which rays spread, or a direction along which all of them
/// run. Behind a mirror the same window looks from the mirrored apex: `behind` composes the mirror
/// into the map, so that however many mirrors a ray has met, its direction stays a projective
/// function of its place in the window, without approximation.
///
/// Source   P. S. Heckbert and P. Hanrahan, "Beam tracing polygonal objects", SIGGRAPH 1984: the
///          virtual eye. The homogeneous apex is ours.
/// Frame    local east, north, up, metres.
/// Error    a few units in the last place for each mirror.
/// Threads  immutable; may be shared.
class BeamView {
 public:
  /// Rays from `apex` in the directions `at_origin + u * by_u + v * by_v`.
  static BeamView from_point(Vec3 apex, Vec3 at_origin, Vec3 by_u, Vec3 by_v);

  /// Rays along `direction` from `origin + u * by_u + v * by_v`.
  static BeamView along(Vec3 direction, Vec3 origin, Vec3 by_u, Vec3 by_v);

  /// The same window, continued from the mirror.
  [[nodiscard]] BeamView behind(const Plane& mirror) const;

  [[nodiscard]] BeamRay ray(WindowPoint p) const;
  [[nodiscard]] Vec3 direction(WindowPoint p) const;
  [[nodiscard]] Homogeneous seen(Vec3 point) const;

  /// Where the ray of `p`, prolonged, meets the plane.
  [[nodiscard]] Vec3 on_plane(const Plane& plane, WindowPoint p) const;

  /// @return  not finite where the plane holds the apex: it is seen edge-on
  [[nodiscard]] Nearness nearness(const Plane& plane) const;

  /// Affine function of space that is `a U + b V + c W`: positive on one side of the plane through
  /// the apex and a line of the window.
  [[nodiscard]] Plane through(double a, double b, double c) const;

  /// Height of the apex over a plane: metres for a point; for a direction positive where the rays
  /// come down on the plane's front.
  [[nodiscard]] double apex_height(const Plane& plane) const;

  bool is_point() const { return is_point_; }

 private:
  BeamView() = default;
  void invert();

  bool is_point_ = true;
  Vec3 origin_, axis_u_, axis_v_, axis_t_;
  Vec3 row_u_, row_v_, row_t_;  ///< of the inverse of the matrix of the axes
};

}  // namespace tenku
