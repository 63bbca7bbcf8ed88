/// An edge that bounds the visible sky, as one sensor sees it.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/altitude.h"
#include "core/units.h"
#include "core/vec3.h"

namespace tenku {

/// An azimuth as an angle (radians, clockwise) from some other, and as a horizontal unit vector.
struct Bearing {
  double offset = 0.0;
  Vec3 along;
};

/// Half-way between two bearings less than half a turn apart.
inline Bearing middle_of(const Bearing& a, const Bearing& b) {
  const double x = a.along.x + b.along.x, y = a.along.y + b.along.y;
  const double scale = 1.0 / std::sqrt(x * x + y * y);
  return {0.5 * (a.offset + b.offset), {scale * x, scale * y, 0.0}};
}

/// A straight edge relative to the sensor, its ends in the order of their azimuths.
///
/// Frame    east, north, up, origin at the sensor.
class OutlineSegment {
 public:
  /// No edge: nothing bounds the sky there.
  OutlineSegment() = default;
  OutlineSegment(Vec3 a, Vec3 b)
      : first_(turns_right(a, b) ? a : b), last_(turns_right(a, b) ? b : a), exists_(true) {}

  bool exists() const { return exists_; }
  /// Whether one outline goes on into the other: the same edge, one that shares an end, or none.
  bool touches(const OutlineSegment& other) const {
    if (!exists_ || !other.exists_) return exists_ == other.exists_;
    return first_ == other.first_ || first_ == other.last_ || last_ == other.first_ ||
           last_ == other.last_;
  }

  /// Azimuth of its first end, and the angle from there to the last one.
  double begin() const { return std::atan2(first_.x, first_.y); }
  double turn() const {
    return std::atan2(across(first_, last_), first_.x * last_.x + first_.y * last_.y);
  }

  /// Tangent of its altitude in the half-plane toward `along`, a horizontal unit vector at an
  /// azimuth between its ends.
  double slope(Vec3 along) const {
    const double before = across(along, first_), after = across(along, last_);
    const double t = before == after ? 0.5 : before / (before - after);
    const double x = first_.x + t * (last_.x - first_.x), y = first_.y + t * (last_.y - first_.y);
    return (first_.z + t * (last_.z - first_.z)) / std::max(x * along.x + y * along.y, 1e-12);
  }

  /// The last end, seen clockwise from `from`, an azimuth between the ends; `limit` if that comes
  /// first. Both lie less than half a turn apart.
  Bearing end_after(const Bearing& from, const Bearing& limit) const {
    return end(last_, from, limit, 1.0);
  }
  /// The same, anticlockwise to the first end.
  Bearing end_before(const Bearing& from, const Bearing& limit) const {
    return end(first_, from, limit, -1.0);
  }

 private:
  /// Positive if the azimuth of `v` lies clockwise of `along`.
  static double across(Vec3 along, Vec3 v) { return v.x * along.y - v.y * along.x; }
  static bool turns_right(Vec3 a, Vec3 b) { return across(a, b) >= 0.0; }

  static Bearing end(Vec3 end, const Bearing& from, const Bearing& limit, double sense) {
    const double beside = sense * across(from.along, end);
    if (!(beside > 0.0)) return from;
    if (sense * across(limit.along, end) >= 0.0) return limit;
    const double ahead = end.x * from.along.x + end.y * from.along.y;
    const double scale = 1.0 / std::sqrt(end.x * end.x + end.y * end.y);
    const double angle =
        ahead > 0.0 ? arctangent(beside / ahead) : kPi / 2.0 + arctangent(-ahead / beside);
    return {from.offset + sense * angle, {scale * end.x, scale * end.y, 0.0}};
  }

  Vec3 first_, last_;
  bool exists_ = false;
};

}  // namespace tenku
