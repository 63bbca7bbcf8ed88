/// Where a moving camera is at each frame.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "core/units.h"
#include "core/vec3.h"
#include "view/camera.h"

namespace tenku {

/// A place that the camera passes.
struct CameraKey {
  double time_s = 0.0;
  Vec3 eye, target;
  Angle horizontal_fov = Angle::degrees(60.0);
};

/// How the camera goes from key to key.
enum class PathCurve {
  CatmullRom,  ///< through all keys, smooth; centripetal, so that it neither loops nor overshoots
  Straight
};

/// How fast.
enum class PathSpeed {
  Keyed,     ///< each key at its time; between two of them evenly along the curve
  Constant,  ///< the same speed from the first key to the last; the times of others do not count
  Eased      ///< as `Constant`, but starts and ends at rest
};

/// Height of the ground under (x, y), nothing where there is none. Metres, local frame.
using GroundHeight = std::function<std::optional<double>(double x, double y)>;

/// What a path is made from.
struct CameraPathRequest {
  std::vector<CameraKey> keys;  ///< in the order of their times; two at least, or one that stands
  PathCurve curve = PathCurve::CatmullRom;
  PathSpeed speed = PathSpeed::Keyed;
  double frames_per_s = 30.0;
  double standing_s = 0.0;  ///< with one key: how long it stands
  int width = 1280, height = 720;
  /// A walk: the eye is this high above the ground, whatever the heights of the keys; the target
  /// keeps its height above the eye.
  std::optional<double> walk_height_m;
};

/// One picture of the film.
struct CameraFrame {
  double time_s = 0.0;
  Vec3 eye, target;
  Angle horizontal_fov = Angle::degrees(60.0);
};

/// All pictures of the film, in order.
///
/// Frame    local east, north, up; metres.
struct CameraPath {
  int width = 1280, height = 720;  ///< pixels
  double frames_per_s = 30.0;
  std::vector<CameraFrame> frames;

  std::size_t size() const { return frames.size(); }
  PerspectiveView view(std::size_t frame) const;
  /// Length of the way of the eye.
  double length_m() const;
};

/// Frames at even times from the first key to the last.
///
/// Source   curve: E. Catmull and R. Rom, "A class of local interpolating splines", 1974, with the
///          centripetal knots of P. Yuksel, S. Schaefer and J. Keyser, "Parameterization and
///          applications of Catmull-Rom curves", CAD 43, 2011: knots apart by the root of the
///          distance. Ease: 3 u^2 - 2 u^3 of the way.
/// Error    speed is even to 1 % of itself: lengths along the curve from 256 pieces a span.
/// @param ground  needed for a walk only
/// @throws InputError  no keys, times that do not rise, a rate or a size out of range, no ground
///                     under a walk, eye and target at one place
CameraPath make_camera_path(const CameraPathRequest& request, const GroundHeight& ground = {});

}  // namespace tenku
