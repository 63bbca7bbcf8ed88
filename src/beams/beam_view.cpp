#include "beams/beam_view.h"

#include "core/error.h"

namespace tenku {

BeamView BeamView::from_point(Vec3 apex, Vec3 at_origin, Vec3 by_u, Vec3 by_v) {
  BeamView view;
  view.origin_ = apex;
  view.axis_t_ = at_origin, view.axis_u_ = by_u, view.axis_v_ = by_v;
  view.invert();
  return view;
}

BeamView BeamView::along(Vec3 direction, Vec3 origin, Vec3 by_u, Vec3 by_v) {
  BeamView view = from_point(origin, direction, by_u, by_v);
  view.is_point_ = false;
  return view;
}

void BeamView::invert() {
  const Vec3 uv = cross(axis_u_, axis_v_);
  const double volume = dot(uv, axis_t_);
  if (!(std::abs(volume) > 0.0)) throw InputError("the axes of a beam's window lie in one plane");
  row_u_ = (1.0 / volume) * cross(axis_v_, axis_t_);
  row_v_ = (1.0 / volume) * cross(axis_t_, axis_u_);
  row_t_ = (1.0 / volume) * uv;
}

BeamView BeamView::behind(const Plane& mirror) const {
  BeamView view = *this;
  view.origin_ = mirror.mirrored(origin_);
  for (Vec3* v :
       {&view.axis_u_, &view.axis_v_, &view.axis_t_, &view.row_u_, &view.row_v_, &view.row_t_}) {
    *v = mirror.mirrored_direction(*v);
  }
  return view;
}

Vec3 BeamView::direction(WindowPoint p) const {
  return is_point_ ? axis_t_ + p.u * axis_u_ + p.v * axis_v_ : axis_t_;
}

BeamRay BeamView::ray(WindowPoint p) const {
  if (is_point_) return {origin_, direction(p)};
  return {origin_ + p.u * axis_u_ + p.v * axis_v_, axis_t_};
}

Homogeneous BeamView::seen(Vec3 point) const {
  const Vec3 d = point - origin_;
  return {dot(row_u_, d), dot(row_v_, d), is_point_ ? dot(row_t_, d) : 1.0};
}

Vec3 BeamView::on_plane(const Plane& plane, WindowPoint p) const {
  const BeamRay at = ray(p);
  return at.origin - plane.height(at.origin) / dot(plane.normal, at.direction) * at.direction;
}

Nearness BeamView::nearness(const Plane& plane) const {
  const double u = dot(plane.normal, axis_u_), v = dot(plane.normal, axis_v_),
               t = dot(plane.normal, axis_t_), h = plane.height(origin_);
  if (is_point_) return {-t / h, -u / h, -v / h};
  return {h / t, u / t, v / t};
}

Plane BeamView::through(double a, double b, double c) const {
  const Vec3 normal = a * row_u_ + b * row_v_ + (is_point_ ? c * row_t_ : Vec3{});
  return {normal, dot(normal, origin_) - (is_point_ ? 0.0 : c)};
}

double BeamView::apex_height(const Plane& plane) const {
  return is_point_ ? plane.height(origin_) : -dot(plane.normal, axis_t_) / length(axis_t_);
}

}  // namespace tenku
