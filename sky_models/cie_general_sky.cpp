#include "sky_models/cie_general_sky.h"

#include <array>
#include <cmath>
#include <string>

#include "core/error.h"

namespace tenku {
namespace {

using Coefficients = CieGeneralSky::Coefficients;

const Coefficients& table_1(int type) {
  static constexpr std::array<Coefficients, 15> kRows{{
      {4.0, -0.70, 0.0, -1.0, 0.00},    //  1  overcast, steep gradation
      {4.0, -0.70, 2.0, -1.5, 0.15},    //  2
      {1.1, -0.80, 0.0, -1.0, 0.00},    //  3
      {1.1, -0.80, 2.0, -1.5, 0.15},    //  4
      {0.0, -1.00, 0.0, -1.0, 0.00},    //  5  uniform
      {0.0, -1.00, 2.0, -1.5, 0.15},    //  6
      {0.0, -1.00, 5.0, -2.5, 0.30},    //  7
      {0.0, -1.00, 10.0, -3.0, 0.45},   //  8
      {-1.0, -0.55, 2.0, -1.5, 0.15},   //  9
      {-1.0, -0.55, 5.0, -2.5, 0.30},   // 10
      {-1.0, -0.55, 10.0, -3.0, 0.45},  // 11
      {-1.0, -0.32, 10.0, -3.0, 0.45},  // 12  clear, low turbidity
      {-1.0, -0.32, 16.0, -3.0, 0.30},  // 13  clear, polluted
      {-1.0, -0.15, 16.0, -3.0, 0.30},  // 14
      {-1.0, -0.15, 24.0, -2.8, 0.15},  // 15
  }};
  if (type < 1 || type > 15) {
    throw InputError("CIE sky type " + std::to_string(type) + " is not in 1..15");
  }
  return kRows[static_cast<std::size_t>(type) - 1];
}

// At the horizon b / 0 is -infinity and its exponential 0: the standard's limit, 1.
double gradation(const Coefficients& k, double cos_zenith_angle) {
  return 1.0 + k.a * std::exp(k.b / cos_zenith_angle);
}

}  // namespace

CieGeneralSky::CieGeneralSky(int type, Vec3 sun, Luminance zenith_luminance)
    : k_(table_1(type)), across_(std::exp(k_.d * kPi / 2.0)), sun_(sun) {
  expects(is_unit(sun), "sun is a unit vector");
  if (!(sun.z > 0.0)) throw InputError("the sun must be above the horizon");
  if (!(zenith_luminance > Luminance(0.0)) || std::isinf(zenith_luminance.value())) {
    throw InputError("zenith luminance must be positive");
  }
  scale_ = (1.0 / relative_luminance(kZenith)) * zenith_luminance;
}

Luminance CieGeneralSky::luminance(Vec3 direction) const {
  return direction.z < 0.0 ? Luminance(0.0) : relative_luminance(direction) * scale_;
}

double CieGeneralSky::indicatrix(Vec3 direction) const {
  if (k_.c == 0.0 && k_.e == 0.0) return 1.0;
  const double chi = angle_between(direction, sun_).in_radians(), cos_chi = dot(direction, sun_);
  return 1.0 + k_.c * (std::exp(k_.d * chi) - across_) + k_.e * cos_chi * cos_chi;
}

double CieGeneralSky::relative_luminance(Vec3 direction) const {
  return gradation(k_, std::abs(direction.z)) * indicatrix(direction);
}

}  // namespace tenku
