#include "sky_models/element_moments.h"

#include <algorithm>
#include <cmath>

#include "sky_models/gauss_legendre.h"

namespace tenku {
namespace {

/// A box in azimuth and altitude, radians.
struct Box {
  double azimuth, azimuth_width, altitude, altitude_width;
};

ElementMoments box_moments(const SkyModel& sky, const Box& box, const GaussLegendre& rule) {
  ElementMoments m;
  for (std::size_t j = 0; j < rule.size(); ++j) {
    const double altitude = box.altitude + rule.point[j] * box.altitude_width;
    const double sine = std::sin(altitude), cosine = std::cos(altitude);
    const double w_altitude = rule.weight[j] * box.altitude_width * cosine * box.azimuth_width;
    for (std::size_t i = 0; i < rule.size(); ++i) {
      const double azimuth = box.azimuth + rule.point[i] * box.azimuth_width;
      const Vec3 d{cosine * std::sin(azimuth), cosine * std::cos(azimuth), sine};
      const double w = w_altitude * rule.weight[i];
      const double l = sky.luminance(d).value();
      m.solid_angle += w;
      m.luminance += w * l;
      m.vector = m.vector + (w * l) * d;
      const double ll = w * l * l;
      const Symmetric3 dd{d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.x * d.z, d.y * d.z};
      for (std::size_t k = 0; k < 6; ++k) m.square[k] += ll * dd[k];
    }
  }
  return m;
}

bool agree(const ElementMoments& a, const ElementMoments& b) {
  constexpr double kTolerance = 1e-5;  // of the poorer rule; the better one is then far closer
  const double scale = std::max(std::abs(a.luminance), 1e-300);
  return std::abs(a.luminance - b.luminance) <= kTolerance * scale &&
         length(a.vector - b.vector) <= kTolerance * scale;
}

ElementMoments adaptive_moments(const SkyModel& sky, const Box& box, int depth) {
  static const GaussLegendre coarse(3), fine(5);
  const ElementMoments better = box_moments(sky, box, fine);
  if (depth == 0 || agree(better, box_moments(sky, box, coarse))) return better;
  ElementMoments sum;
  const double w = 0.5 * box.azimuth_width, h = 0.5 * box.altitude_width;
  for (const double i : {0.0, 1.0}) {
    for (const double j : {0.0, 1.0}) {
      sum += adaptive_moments(sky, {box.azimuth + i * w, w, box.altitude + j * h, h}, depth - 1);
    }
  }
  return sum;
}

int pieces(double angle, double longest) {
  return std::max(1, static_cast<int>(std::ceil(angle / longest)));
}

}  // namespace

ElementMoments& ElementMoments::operator+=(const ElementMoments& other) {
  solid_angle += other.solid_angle;
  luminance += other.luminance;
  vector = vector + other.vector;
  for (std::size_t k = 0; k < 6; ++k) square[k] += other.square[k];
  return *this;
}

ElementMoments element_moments(const SkyModel& sky, const SkyCell& cell) {
  constexpr int kHalvings = 7;
  const double detail = sky.detail().in_radians();
  const double longest = std::clamp(6.0 * detail, 0.01, 0.2);
  const int halvings = detail < 0.9 * kPi / 180.0 ? 2 : kHalvings;  // pixels have kinks everywhere
  const double bottom = std::asin(cell.sine_from), top = std::asin(std::min(1.0, cell.sine_to));
  const int rows = pieces(top - bottom, longest);
  const double height = (top - bottom) / rows;
  ElementMoments sum;
  for (int r = 0; r < rows; ++r) {
    const double altitude = bottom + r * height;
    const double turn = cell.azimuth_to - cell.azimuth_from;
    const int columns = pieces(turn * std::cos(altitude), longest);
    const double width = turn / columns;
    for (int c = 0; c < columns; ++c) {
      sum +=
          adaptive_moments(sky, {cell.azimuth_from + c * width, width, altitude, height}, halvings);
    }
  }
  sum.solid_angle = cell.solid_angle();  // exactly
  return sum;
}

Symmetric3 sample_covariance(const ElementMoments& m) {
  const Vec3 v = m.vector;
  const Symmetric3 vv{v.x * v.x, v.y * v.y, v.z * v.z, v.x * v.y, v.x * v.z, v.y * v.z};
  Symmetric3 covariance;
  for (std::size_t k = 0; k < 6; ++k) covariance[k] = m.solid_angle * m.square[k] - vv[k];
  return covariance;
}

// The trigonometric solution of the characteristic cubic.
double largest_eigenvalue(const Symmetric3& a) {
  const double mean = (a[0] + a[1] + a[2]) / 3.0;
  const double x = a[0] - mean, y = a[1] - mean, z = a[2] - mean;
  const double off = a[3] * a[3] + a[4] * a[4] + a[5] * a[5];
  const double p = std::sqrt((x * x + y * y + z * z + 2.0 * off) / 6.0);
  if (!(p > 0.0)) return std::max(0.0, mean);
  const double determinant =
      x * (y * z - a[5] * a[5]) - a[3] * (a[3] * z - a[5] * a[4]) + a[4] * (a[3] * a[5] - y * a[4]);
  const double r = std::clamp(0.5 * determinant / (p * p * p), -1.0, 1.0);
  return std::max(0.0, mean + 2.0 * p * std::cos(std::acos(r) / 3.0));
}

}  // namespace tenku
