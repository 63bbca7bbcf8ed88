#include "sky_models/sky_element.h"

#include <algorithm>
#include <cmath>

namespace tenku {
namespace {

Vec3 at(double azimuth, double sine) {
  const double cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
  return {cosine * std::sin(azimuth), cosine * std::cos(azimuth), sine};
}

int steps_over(double angle, Angle longest) {
  return std::max(1, static_cast<int>(std::ceil(angle / longest.in_radians() - 1e-9)));
}

void append_parallel(std::vector<Vec3>& points, double from, double to, double sine,
                     Angle longest) {
  const double cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
  const int steps = steps_over(std::abs(to - from) * cosine, longest);
  for (int i = 0; i < steps; ++i) points.push_back(at(from + (to - from) * i / steps, sine));
}

void append_meridian(std::vector<Vec3>& points, double azimuth, double sine_from, double sine_to,
                     Angle longest) {
  const double from = std::asin(sine_from), to = std::asin(sine_to);
  const int steps = steps_over(std::abs(to - from), longest);
  for (int i = 0; i < steps; ++i) {
    points.push_back(at(azimuth, std::sin(from + (to - from) * i / steps)));
  }
}

}  // namespace

Vec3 SkyCell::direction(double u, double v) const {
  return at(azimuth_from + u * (azimuth_to - azimuth_from), sine_from + v * (sine_to - sine_from));
}

bool SkyCell::is_cap() const {
  return sine_to >= 1.0 && azimuth_to - azimuth_from >= 2.0 * kPi - 1e-12;
}

Vec3 SkyCell::centre() const { return is_cap() ? kZenith : direction(0.5, 0.5); }

std::vector<Vec3> outline(const SkyCell& cell, Angle longest) {
  std::vector<Vec3> points;
  if (cell.is_cap()) {
    append_parallel(points, cell.azimuth_from, cell.azimuth_to, cell.sine_from, longest);
    return points;
  }
  append_parallel(points, cell.azimuth_from, cell.azimuth_to, cell.sine_from, longest);
  append_meridian(points, cell.azimuth_to, cell.sine_from, cell.sine_to, longest);
  if (cell.sine_to < 1.0) {  // at the zenith the upper edge is a point, the next one's first
    append_parallel(points, cell.azimuth_to, cell.azimuth_from, cell.sine_to, longest);
  }
  append_meridian(points, cell.azimuth_from, cell.sine_to, cell.sine_from, longest);
  return points;
}

}  // namespace tenku
