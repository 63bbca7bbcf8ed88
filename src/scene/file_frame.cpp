#include "scene/file_frame.h"

#include <GeographicLib/TransverseMercator.hpp>
#include <cmath>

#include "core/error.h"

namespace tenku {
namespace {

Vec3 apply(const FileFrame::Rows& rows, Vec3 v) {
  return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
}

FileFrame::Rows inverse_of(const FileFrame::Rows& m) {
  const Vec3 a = cross(m[1], m[2]), b = cross(m[2], m[0]), c = cross(m[0], m[1]);
  const double determinant = dot(m[0], a);
  expects(std::abs(determinant) > 0.0, "a frame can be inverted");
  const double k = 1.0 / determinant;
  return {{{k * a.x, k * b.x, k * c.x}, {k * a.y, k * b.y, k * c.y}, {k * a.z, k * b.z, k * c.z}}};
}

Vec3 swapped(Vec3 v) { return {v.y, v.x, v.z}; }

const GeographicLib::TransverseMercator& mercator() {
  return GeographicLib::TransverseMercator::UTM();
}

// The library's object carries the UTM scale; dividing it out leaves scale 1 on the meridian.
double utm_scale() { return mercator().CentralScale(); }

double origin_northing(double latitude, double longitude) {
  double x = 0.0, y = 0.0;
  mercator().Forward(longitude, latitude, longitude, x, y);
  return y / utm_scale();
}

}  // namespace

FileFrame FileFrame::affine(Vec3 origin, Rows rows) {
  FileFrame frame;
  frame.origin_ = origin;
  frame.rows_ = rows;
  frame.inverse_ = inverse_of(rows);
  return frame;
}

FileFrame FileFrame::geographic(Vec3 origin, bool latitude_first, Angle turn) {
  const double c = std::cos(turn.in_radians()), s = std::sin(turn.in_radians());
  FileFrame frame = affine(origin, {{{c, s, 0}, {-s, c, 0}, {0, 0, 1}}});
  frame.geographic_ = true;
  frame.latitude_first_ = latitude_first;
  frame.northing_ =
      latitude_first ? origin_northing(origin.x, origin.y) : origin_northing(origin.y, origin.x);
  return frame;
}

Vec3 FileFrame::to_local(Vec3 p) const {
  if (!geographic_) return apply(rows_, p - origin_);
  const Vec3 degrees = latitude_first_ ? swapped(p) : p;
  const Vec3 centre = latitude_first_ ? swapped(origin_) : origin_;
  double x = 0.0, y = 0.0;
  mercator().Forward(centre.x, degrees.y, degrees.x, x, y);
  return apply(rows_, {x / utm_scale(), y / utm_scale() - northing_, p.z - origin_.z});
}

Vec3 FileFrame::to_file(Vec3 p) const {
  const Vec3 back = apply(inverse_, p);
  if (!geographic_) return back + origin_;
  const Vec3 centre = latitude_first_ ? swapped(origin_) : origin_;
  double latitude = 0.0, longitude = 0.0;
  mercator().Reverse(centre.x, back.x * utm_scale(), (back.y + northing_) * utm_scale(), latitude,
                     longitude);
  const Vec3 degrees{longitude, latitude, back.z + origin_.z};
  return latitude_first_ ? swapped(degrees) : degrees;
}

Vec3 FileFrame::direction_to_local(Vec3 direction) const {
  return normalized(apply(rows_, latitude_first_ ? swapped(direction) : direction));
}

Vec3 FileFrame::direction_to_file(Vec3 direction) const {
  const Vec3 along = normalized(apply(inverse_, direction));
  return latitude_first_ ? swapped(along) : along;
}

}  // namespace tenku
