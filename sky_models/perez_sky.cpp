#include "sky_models/perez_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/error.h"
#include "sky_models/hemisphere_integral.h"

namespace tenku {
namespace {

constexpr double kSolarConstant = 1367.0;  // W/m2
constexpr std::size_t kBins = 8;
constexpr double kEpsilonMax = 12.009, kDeltaMin = 0.01, kDeltaMax = 0.6;

// Upper limits of clearness of the bins 1 to 7. Perez 1990, table 1.
constexpr std::array<double, kBins - 1> kBinEnds{1.065, 1.230, 1.500, 1.950, 2.800, 4.500, 6.200};

// Four numbers for each of a, b, c, d, e. Perez 1993, table 1.
using Row = std::array<double, 20>;
constexpr std::array<Row, kBins> kTable1{{
    {1.3525, -0.2576, -0.2690, -1.4366, -0.7670, 0.0007, 1.2734, -0.1233, 2.8000,  0.6004,
     1.2375, 1.0000,  1.8734,  0.6297,  0.9738,  0.2809, 0.0356, -0.1246, -0.5718, 0.9938},
    {-1.2219, -0.7730, 1.4148,  1.1016,  -0.2054, 0.0367, -3.9128, 0.9156, 6.9750,  0.1774,
     6.4477,  -0.1239, -1.5798, -0.5081, -1.7812, 0.1080, 0.2624,  0.0672, -0.2190, -0.4285},
    {-1.1000,  -0.2515, 0.8952,  0.0156, 0.2782, -0.1812, -4.5000, 1.1766, 24.7219, -13.0812,
     -37.7000, 34.8438, -5.0000, 1.5218, 3.9229, -2.6204, -0.0156, 0.1597, 0.4199,  -0.5562},
    {-0.5484,  -0.6654, -0.2672, 0.7117, 0.7234, -0.6219, -5.6812, 2.6297,  33.3389, -18.3000,
     -62.2500, 52.0781, -3.5000, 0.0016, 1.1477, 0.1062,  0.4659,  -0.3296, -0.0876, -0.0329},
    {-0.6000,  -0.3566, -2.5000, 2.3250,  0.2937, 0.0496, -5.6812, 1.8415, 21.0000, -4.7656,
     -21.5906, 7.2492,  -3.5000, -0.1554, 1.4062, 0.3988, 0.0032,  0.0766, -0.0656, -0.1294},
    {-1.0156, -0.3670, 1.0078,  1.4051,  0.2875,  -0.5328, -3.8500, 3.3750, 14.0000, -0.9999,
     -7.1406, 7.5469,  -3.4000, -0.1078, -1.0750, 1.5702,  -0.0672, 0.4016, 0.3017,  -0.4844},
    {-1.0000, 0.0211,  0.5025,  -0.5119, -0.3000, 0.1922, 0.7023, -1.6317, 19.0000, -5.0000,
     1.2438,  -1.9094, -4.0000, 0.0250,  0.3844,  0.2656, 1.0468, -0.3788, -2.4517, 1.4656},
    {-1.0500,  0.0289,  0.4260,  0.3590, -0.3250, 0.1156, 0.7781, 0.0025,  31.0625, -14.5000,
     -46.1148, 55.3750, -7.2312, 0.4050, 13.3500, 0.6234, 1.5000, -0.6426, 1.8564,  0.5636},
}};

// Luminous efficacies: a + b W + c f(Z) + d g(delta). Perez 1990, table 4.
struct Efficacy {
  double a, b, c, d;
};
constexpr std::array<Efficacy, kBins> kDiffuseEfficacy{{
    {97.24, -0.46, 12.00, -8.91},
    {107.22, 1.15, 0.59, -3.95},
    {104.97, 2.96, -5.53, -8.77},
    {102.39, 5.59, -13.95, -13.90},
    {100.71, 5.94, -22.75, -23.74},
    {106.42, 3.83, -36.15, -28.83},
    {141.88, 1.90, -53.24, -14.03},
    {152.23, 0.35, -45.27, -7.98},
}};
constexpr std::array<Efficacy, kBins> kBeamEfficacy{{
    {57.20, -4.55, -2.98, 117.12},
    {98.99, -3.46, -1.21, 12.38},
    {109.83, -4.90, -1.71, -8.81},
    {110.34, -5.84, -1.99, -4.56},
    {106.36, -3.97, -1.75, -6.16},
    {107.19, -1.25, -1.51, -26.73},
    {105.75, 0.77, -1.26, -34.44},
    {101.18, 1.58, -1.10, -8.29},
}};

void check(const PerezConditions& k) {
  const auto check_irradiance = [](Irradiance e, const char* name) {
    if (!(e.value() >= 0.0 && e.value() <= 2000.0)) {
      throw InputError(std::string(name) + " irradiance " + std::to_string(e.value()) +
                       " W/m2 is not in 0..2000");
    }
  };
  check_irradiance(k.direct_normal, "direct normal");
  check_irradiance(k.diffuse_horizontal, "diffuse horizontal");
  if (!(std::abs(k.dew_point_c) <= 100.0)) {
    throw InputError("dew point " + std::to_string(k.dew_point_c) + " C is not in -100..100");
  }
  expects(is_unit(k.sun) && k.sun.z > -1e-9, "the sun is a direction above the horizon");
}

double air_mass(double zenith_deg) {  // Kasten 1966
  return 1.0 / (std::cos(zenith_deg * kPi / 180.0) +
                0.15 * std::pow(93.885 - std::min(zenith_deg, 90.0), -1.253));
}

double clamped(PerezParameters& p, double value, double low, double high, const char* name) {
  const double result = std::clamp(value, low, high);
  if (result != value) {
    p.findings.push_back({"perez_limits", Severity::Note, "", "",
                          std::string(name) + " " + std::to_string(value) +
                              " is outside the range of the Perez model",
                          "clamped to " + std::to_string(result)});
  }
  return result;
}

/// Clearness, brightness and the bin.
void set_sky_condition(PerezParameters& p, const PerezConditions& k, double zenith_rad) {
  const double dhi = k.diffuse_horizontal.value(), dni = k.direct_normal.value();
  const double z3 = 1.041 * zenith_rad * zenith_rad * zenith_rad;
  const double ratio = dhi > 0.0 ? (dhi + dni) / dhi : (dni > 0.0 ? kEpsilonMax * (1.0 + z3) : 1.0);
  p.epsilon = clamped(p, (ratio + z3) / (1.0 + z3), 1.0, kEpsilonMax, "sky clearness");
  p.delta = clamped(p, dhi * air_mass(zenith_rad * 180.0 / kPi) / k.extraterrestrial.value(),
                    kDeltaMin, kDeltaMax, "sky brightness");
  p.bin = 1 + static_cast<int>(std::upper_bound(kBinEnds.begin(), kBinEnds.end(), p.epsilon) -
                               kBinEnds.begin());
}

/// Equations 6 to 8 of the paper.
void set_coefficients(PerezParameters& p, double z) {
  const Row& x = kTable1[static_cast<std::size_t>(p.bin) - 1];
  double delta = p.delta;
  if (p.epsilon > 1.065 && p.epsilon < 2.8 && delta < 0.2) {
    delta = 0.2;
    p.findings.push_back({"perez_limits", Severity::Note, "", "",
                          "sky brightness " + std::to_string(p.delta) +
                              " is too dark for this clearness, by the rule of the model's authors",
                          "0.2 was used in the luminance distribution"});
  }
  const auto linear = [&](std::size_t i) {
    return x[i] + x[i + 1] * z + delta * (x[i + 2] + x[i + 3] * z);
  };
  p.a = linear(0);
  p.b = linear(4);
  p.e = linear(16);
  if (p.bin > 1) {
    p.c = linear(8);
    p.d = linear(12);
  } else {
    p.c = std::exp(std::pow(delta * (x[8] + x[9] * z), x[10])) - x[11];
    p.d = -std::exp(delta * (x[12] + x[13] * z)) + x[14] + delta * x[15];
  }
}

void set_efficacies(PerezParameters& p, double dew_point_c, double z) {
  const double water_cm = std::exp(0.07 * dew_point_c - 0.075);
  const Efficacy& s = kDiffuseEfficacy[static_cast<std::size_t>(p.bin) - 1];
  const Efficacy& b = kBeamEfficacy[static_cast<std::size_t>(p.bin) - 1];
  p.diffuse_efficacy =
      std::max(0.0, s.a + s.b * water_cm + s.c * std::cos(z) + s.d * std::log(p.delta));
  p.beam_efficacy =
      std::max(0.0, b.a + b.b * water_cm + b.c * std::exp(5.73 * z - 5.0) + b.d * p.delta);
}

}  // namespace

PerezParameters perez_parameters(const PerezConditions& conditions) {
  check(conditions);
  const double z = std::min(angle_between(conditions.sun, kZenith).in_radians(), kPi / 2.0);
  PerezParameters p;
  set_sky_condition(p, conditions, z);
  set_coefficients(p, z);
  set_efficacies(p, conditions.dew_point_c, z);
  return p;
}

PerezSky::PerezSky(const PerezParameters& parameters, Vec3 sun, Illuminance horizontal)
    : k_(parameters), sun_(sun) {
  expects(horizontal >= Illuminance(0.0), "an illuminance is not negative");
  const double relative =
      hemisphere_integral([this](Vec3 d) { return relative_luminance(d) * d.z; },
                          normalized({sun.x, sun.y, std::max(sun.z, 0.0)}));
  expects(relative > 0.0, "a sky shines somewhere");
  scale_ = Luminance(horizontal.value() / relative);
}

Luminance PerezSky::luminance(Vec3 direction) const {
  return direction.z < 0.0 ? Luminance(0.0) : relative_luminance(direction) * scale_;
}

double PerezSky::relative_luminance(Vec3 direction) const {
  const Angle gamma = angle_between(direction, sun_);
  const double cos_gamma = std::cos(gamma.in_radians());
  return std::max(
      0.0, (1.0 + k_.a * std::exp(k_.b / std::abs(direction.z))) *
               (1.0 + k_.c * std::exp(k_.d * gamma.in_radians()) + k_.e * cos_gamma * cos_gamma));
}

Irradiance extraterrestrial_irradiance(int day_of_year) {
  const double g = 2.0 * kPi * (day_of_year - 1) / 365.0;
  return Irradiance(kSolarConstant * (1.00011 + 0.034221 * std::cos(g) + 0.00128 * std::sin(g) +
                                      0.000719 * std::cos(2.0 * g) + 0.000077 * std::sin(2.0 * g)));
}

Irradiance extraterrestrial_irradiance_at(double distance_au) {
  return Irradiance(kSolarConstant / (distance_au * distance_au));
}

}  // namespace tenku
