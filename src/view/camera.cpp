#include "view/camera.h"

#include <cmath>
#include <string>

#include "core/error.h"

namespace tenku {
namespace {

constexpr int kLargestSide = 32768;

void check_size(int width, int height) {
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide) {
    throw InputError("picture size " + std::to_string(width) + "x" + std::to_string(height) +
                     " is not within 1..32768 pixels a side");
  }
}

void check(const PerspectiveView& view) {
  if (!is_finite(view.eye) || !is_finite(view.target)) {
    throw InputError("eye and target of the view must be finite numbers");
  }
  if (!(length(view.target - view.eye) > 0.0)) {
    throw InputError("eye and target of the view are the same point");
  }
  const double fov = view.horizontal_fov.in_degrees();
  if (!(fov > 0.0 && fov < 180.0)) {
    throw InputError("field of view " + std::to_string(fov) + " is not between 0 and 180 degrees");
  }
  check_size(view.width, view.height);
}

// Straight up or down the zenith gives no upright; north does.
Vec3 upright_for(Vec3 forward) {
  return std::hypot(forward.x, forward.y) > 1e-9 ? kZenith : Vec3{0.0, 1.0, 0.0};
}

}  // namespace

PerspectiveCamera::PerspectiveCamera(const PerspectiveView& view)
    : eye_(view.eye), width_(view.width), height_(view.height) {
  check(view);
  forward_ = normalized(view.target - view.eye);
  right_ = normalized(cross(forward_, upright_for(forward_)));
  up_ = cross(right_, forward_);
  pixel_ = 2.0 * std::tan(0.5 * view.horizontal_fov.in_radians()) / width_;
}

Vec3 PerspectiveCamera::ray(double px, double py) const {
  const double x = (px - 0.5 * width_) * pixel_, y = (0.5 * height_ - py) * pixel_;
  return normalized(forward_ + x * right_ + y * up_);
}

BeamView PerspectiveCamera::window() const {
  const Vec3 by_u = pixel_ * right_, by_v = -pixel_ * up_;
  return BeamView::from_point(eye_, forward_ - 0.5 * width_ * by_u - 0.5 * height_ * by_v, by_u,
                              by_v);
}

std::optional<PixelPosition> PerspectiveCamera::pixel_of(Vec3 point) const {
  const Vec3 d = point - eye_;
  const double depth = dot(d, forward_);
  if (!(depth > 0.0)) return std::nullopt;
  return PixelPosition{0.5 * width_ + dot(d, right_) / (depth * pixel_),
                       0.5 * height_ - dot(d, up_) / (depth * pixel_)};
}

PlanCamera::PlanCamera(const PlanView& view)
    : west_(view.west), north_(view.north), width_(view.width) {
  const double across = view.east - view.west, along = view.north - view.south;
  if (!(across > 0.0 && along > 0.0 && std::isfinite(across) && std::isfinite(along))) {
    throw InputError("the rectangle of the plan is empty or not finite");
  }
  if (view.width < 1) check_size(view.width, 1);
  pixel_m_ = across / view.width;
  const double rows = std::round(along / pixel_m_);
  if (rows > kLargestSide) check_size(view.width, kLargestSide + 1);
  height_ = rows < 1.0 ? 1 : static_cast<int>(rows);
  check_size(width_, height_);
}

Vec3 PlanCamera::point(double px, double py, double z) const {
  return {west_ + px * pixel_m_, north_ - py * pixel_m_, z};
}

PixelPosition PlanCamera::pixel_of(Vec3 point) const {
  return {(point.x - west_) / pixel_m_, (north_ - point.y) / pixel_m_};
}

}  // namespace tenku
