#include "sky_models/sky_level.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/vec3.h"
#include "sky_models/cie_general_sky.h"
#include "sky_models/hemisphere_integral.h"

namespace tenku {
namespace {

constexpr double kLuminousSolarConstant_lx = 133800.0;
constexpr int kLastOvercastType = 6;

// Typical ratio of diffuse to extraterrestrial horizontal illuminance, types 1 to 6.
constexpr std::array<double, kLastOvercastType> kDiffuseRatio{0.10, 0.18, 0.15, 0.22, 0.20, 0.38};

// Zenith luminance in kcd/m2: (A1 Tv + A2) sin g + 0.7 (Tv + 1) sin^C g / cos^D g + 0.04 Tv.
struct ClearZenith {
  double turbidity, a1, a2, c, d;
};
constexpr std::array<ClearZenith, 9> kClearZenith{{
    {12.0, 0.957, 1.790, 4.52, 0.64},  //  7
    {10.0, 0.830, 2.030, 4.94, 0.70},  //  8
    {12.0, 0.600, 1.500, 3.45, 0.50},  //  9
    {10.0, 0.567, 2.610, 4.27, 0.63},  // 10
    {4.0, 1.440, -0.750, 4.60, 0.72},  // 11
    {2.5, 1.036, 0.710, 4.43, 0.74},   // 12
    {4.5, 1.244, -0.840, 4.61, 0.76},  // 13
    {5.0, 0.881, 0.453, 4.40, 0.79},   // 14
    {4.0, 0.418, 1.950, 4.13, 0.79},   // 15
}};

Luminance zenith_luminance(const ClearZenith& k, Angle sun) {
  const double s = std::sin(sun.in_radians()), c = std::cos(sun.in_radians());
  return Luminance(1000.0 * ((k.a1 * k.turbidity + k.a2) * s +
                             0.7 * (k.turbidity + 1.0) * std::pow(s, k.c) / std::pow(c, k.d) +
                             0.04 * k.turbidity));
}

// Kasten and Young 1989.
double relative_air_mass(Angle sun) {
  return 1.0 /
         (std::sin(sun.in_radians()) + 0.50572 * std::pow(sun.in_degrees() + 6.07995, -1.6364));
}

// Extinction of an ideal atmosphere after Clear, 1982, as in Darula and Kittler.
Illuminance sun_normal(double turbidity, Angle sun) {
  const double m = relative_air_mass(sun);
  const double extinction = 1.0 / (9.9 + 0.043 * m);
  return Illuminance(kLuminousSolarConstant_lx * std::exp(-extinction * m * turbidity));
}

}  // namespace

Illuminance overcast_illuminance(Angle sun) {
  if (!(sun > Angle())) return Illuminance(0.0);
  return Illuminance(300.0 + 21000.0 * std::sin(sun.in_radians()));
}

CieSkyLevel cie_sky_level(int type, Angle sun) {
  expects(sun > Angle(), "the sun is above the horizon");
  const double sine = std::sin(sun.in_radians());
  if (type <= kLastOvercastType) {
    const double ratio = kDiffuseRatio.at(static_cast<std::size_t>(type) - 1);
    return {Illuminance(ratio * kLuminousSolarConstant_lx * sine), Illuminance(0.0)};
  }
  const ClearZenith& k = kClearZenith.at(static_cast<std::size_t>(type - kLastOvercastType) - 1);
  const Angle held = std::min(sun, Angle::degrees(75.0));
  const Vec3 direction = direction_from(Angle(), held);
  const CieGeneralSky sky(type, direction, zenith_luminance(k, held));
  const double rise = sine / std::sin(held.in_radians());
  return {rise * horizontal_illuminance(sky, direction), sun_normal(k.turbidity, sun)};
}

}  // namespace tenku
