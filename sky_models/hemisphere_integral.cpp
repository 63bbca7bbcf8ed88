#include "sky_models/hemisphere_integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "sky_models/gauss_legendre.h"

namespace tenku {
namespace {

constexpr std::size_t kRadialPoints = 32;   // in each interval
constexpr std::size_t kAngularPoints = 48;  // in each part of a circle

/// Polar coordinates about the peak; `up` points to the zenith side.
struct PolarFrame {
  Vec3 axis, up, side;

  Vec3 direction(double chi, double psi) const {
    return std::cos(chi) * axis + std::sin(chi) * (std::cos(psi) * up + std::sin(psi) * side);
  }
};

PolarFrame polar_frame(Vec3 peak) {
  const Vec3 sideways = cross(kZenith, peak);
  const Vec3 side = length(sideways) > 1e-12 ? normalized(sideways) : Vec3{1.0, 0.0, 0.0};
  return {peak, normalized(cross(peak, side)), side};
}

/// Half the arc of the circle of radius chi about the peak that lies above the horizon.
double half_arc(double chi, double peak_altitude) {
  const double k = -std::sin(peak_altitude) * std::cos(chi) /
                   std::max(std::cos(peak_altitude) * std::sin(chi), 1e-300);
  return std::acos(std::clamp(k, -1.0, 1.0));
}

/// Angles psi at which the circle of radius chi crosses the plane through the observer with normal
/// n: A cos psi + B sin psi + C = 0.
std::vector<double> crossings(const PolarFrame& frame, double chi, Vec3 n) {
  const double a = std::sin(chi) * dot(frame.up, n), b = std::sin(chi) * dot(frame.side, n);
  const double c = std::cos(chi) * dot(frame.axis, n), r = std::hypot(a, b);
  if (!(std::abs(c) < r)) return {};
  const double middle = std::atan2(b, a), half = std::acos(-c / r);
  return {std::remainder(middle - half, 2.0 * kPi), std::remainder(middle + half, 2.0 * kPi)};
}

double circle_integral(const std::function<double(Vec3)>& f, const PolarFrame& frame, double chi,
                       double arc, Vec3 kink) {
  static const GaussLegendre rule(kAngularPoints);
  std::vector<double> ends{-arc, 0.0, arc};
  for (const double psi : crossings(frame, chi, kink)) {
    if (std::abs(psi) < arc) ends.push_back(psi);
  }
  std::sort(ends.begin(), ends.end());
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double width = ends[k + 1] - ends[k];
    for (std::size_t i = 0; i < rule.size(); ++i) {
      sum += width * rule.weight[i] * f(frame.direction(chi, ends[k] + width * rule.point[i]));
    }
  }
  return sum;
}

}  // namespace

double hemisphere_integral(const std::function<double(Vec3)>& f, Vec3 peak, Vec3 kink) {
  expects(is_unit(peak) && peak.z > -1e-9, "the peak is a direction above the horizon");
  static const GaussLegendre rule(kRadialPoints);
  const PolarFrame frame = polar_frame(peak);
  const double altitude = altitude_of(peak).in_radians();
  const double to_kink = std::asin(std::clamp(dot(peak, kink), -1.0, 1.0));
  std::array<double, 8> ends{
      0.0, altitude,          kPi / 2.0 - altitude,   kPi / 2.0, kPi - altitude,
      0.3, std::abs(to_kink), kPi - std::abs(to_kink)};
  std::sort(ends.begin(), ends.end());
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double from = ends[k], width = std::min(ends[k + 1], kPi - altitude) - from;
    if (!(width > 0.0)) continue;
    for (std::size_t i = 0; i < rule.size(); ++i) {
      // A smooth step in place of the variable: the arc's square-root ends disappear.
      const double t = rule.point[i];
      const double chi = from + width * t * t * (3.0 - 2.0 * t);
      const double step = width * 6.0 * t * (1.0 - t);
      const double arc = half_arc(chi, altitude);
      sum += rule.weight[i] * step * std::sin(chi) * circle_integral(f, frame, chi, arc, kink);
    }
  }
  return sum;
}

Illuminance horizontal_illuminance(const SkyModel& sky, Vec3 peak) {
  return plane_illuminance(sky, peak, kZenith);
}

Illuminance plane_illuminance(const SkyModel& sky, Vec3 peak, Vec3 normal) {
  return Illuminance(hemisphere_integral(
      [&](Vec3 d) {
        const double cosine = dot(d, normal);
        return cosine > 0.0 ? sky.luminance(d).value() * cosine : 0.0;
      },
      peak, normal));
}

}  // namespace tenku
