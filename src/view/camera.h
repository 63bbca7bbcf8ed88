/// Where the eye is and which direction each pixel looks in.
#pragma once

#include <optional>

#include "beams/beam_view.h"
#include "core/units.h"
#include "core/vec3.h"
#include "view/image.h"

namespace tenku {

/// What a perspective camera is made from.
struct PerspectiveView {
  Vec3 eye, target;
  Angle horizontal_fov = Angle::degrees(60.0);  ///< across the width of the picture
  int width = 512, height = 512;                ///< pixels
};

/// Pinhole camera, its picture as the eye sees the world: looking north, east is to the right.
///
/// The picture's upright is the zenith; looking straight up or down it is north.
///
/// Frame    x east, y north, z up.
/// Threads  immutable after construction; may be shared.
class PerspectiveCamera {
 public:
  /// @throws InputError if a coordinate is not finite, eye and target coincide, the field of view
  ///         is not in (0, 180) degrees or the size not in 1..32768 by 1..32768
  explicit PerspectiveCamera(const PerspectiveView& view);

  /// Unit direction in which the place (px, py) of the picture looks.
  [[nodiscard]] Vec3 ray(double px, double py) const;

  /// The picture as the window of beams: places are pixels.
  [[nodiscard]] BeamView window() const;

  /// Where `point` appears; nothing if it is not in front of the eye. May lie off the picture.
  [[nodiscard]] std::optional<PixelPosition> pixel_of(Vec3 point) const;

  /// Width in metres that one pixel in the middle of the picture covers at `distance_m`, on a
  /// surface that faces the eye.
  [[nodiscard]] double footprint_m(double distance_m) const { return pixel_ * distance_m; }

  Vec3 eye() const { return eye_; }
  Vec3 forward() const { return forward_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  Vec3 eye_, forward_, right_, up_;
  int width_, height_;
  double pixel_;  ///< width of a pixel on the image plane at distance 1
};

/// What a plan camera is made from: the rectangle of the ground that fills the picture.
struct PlanView {
  double west = 0.0, south = 0.0, east = 1.0, north = 1.0;  ///< metres
  int width = 512;                                          ///< pixels; the height follows
};

/// Orthographic camera that looks straight down: a map, north up and east to the right.
///
/// Pixels are square; the height of the picture follows from the rectangle, rounded to a pixel.
class PlanCamera {
 public:
  /// @throws InputError if the rectangle is empty or not finite, or the picture's size is not in
  ///         1..32768 by 1..32768
  explicit PlanCamera(const PlanView& view);

  /// Direction in which every pixel looks.
  static constexpr Vec3 ray() { return {0.0, 0.0, -1.0}; }

  /// Point at the height `z` that appears at (px, py).
  [[nodiscard]] Vec3 point(double px, double py, double z) const;

  [[nodiscard]] PixelPosition pixel_of(Vec3 point) const;

  double footprint_m() const { return pixel_m_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  double west_, north_, pixel_m_;
  int width_, height_;
};

}  // namespace tenku
