/// The all-weather sky, from measured irradiance.
#pragma once

#include <vector>

#include "core/finding.h"
#include "sky_models/sky_model.h"

namespace tenku {

/// What was measured, and where the sun stood.
struct PerezConditions {
  Irradiance direct_normal, diffuse_horizontal;
  Irradiance extraterrestrial{1367.0};  ///< on a plane facing the sun, at the date
  double dew_point_c = 10.97353115;     ///< 2 cm of precipitable water, where it is not known
  Vec3 sun = kZenith;                   ///< unit, on or above the horizon
};

/// The steps from irradiance to the coefficients of the luminance distribution.
struct PerezParameters {
  double epsilon = 1.0;  ///< sky clearness, clamped
  double delta = 0.01;   ///< sky brightness, clamped
  int bin = 1;           ///< of clearness, 1 (overcast) to 8 (clear)
  double a = 0.0, b = 0.0, c = 0.0, d = 0.0, e = 0.0;
  double diffuse_efficacy = 0.0;  ///< lm/W
  double beam_efficacy = 0.0;     ///< lm/W
  std::vector<Finding> findings;  ///< one for each clamp
};

/// Source   R. Perez, R. Seals and J. Michalsky, "All-weather model for sky luminance
///          distribution", Solar Energy 50(3), 1993, equations 3-8 and table 1; efficacies: R.
///          Perez et al., "Modeling daylight availability and irradiance components from direct and
///          global irradiance", Solar Energy 44(5), 1990, equations 7-8 and table 4; air mass:
///          F. Kasten, 1966; limits (epsilon 1 to 12.01, delta 0.01 to 0.6, delta at least 0.2 for
///          epsilon between 1.065 and 2.8): as in gendaylit of J.-J. Delaunay and J. Wienold.
/// @throws InputError if an irradiance is negative or no number, or the dew point is
PerezParameters perez_parameters(const PerezConditions& conditions);

/// Luminance of the sky by the Perez all-weather model.
///
/// Source   as `perez_parameters`; scaled by the exact integral of the relative luminance.
/// Frame    x east, y north, z up.
/// Valid    sun on or above the horizon. Where the formula is negative the luminance is zero.
/// Error    against the formula itself 1e-7.
class PerezSky : public SkyModel {
 public:
  /// @param sun                     unit vector
  /// @param horizontal_illuminance  of the sky alone; zero or positive
  PerezSky(const PerezParameters& parameters, Vec3 sun, Illuminance horizontal_illuminance);

  [[nodiscard]] Luminance luminance(Vec3 direction) const override;

  /// The distribution before scaling.
  [[nodiscard]] double relative_luminance(Vec3 direction) const;

 private:
  PerezParameters k_;
  Vec3 sun_;
  Luminance scale_{1.0};
};

/// Extraterrestrial irradiance on a plane facing the sun.
///
/// Source   solar constant 1367 W/m2 (as the model was fitted with); J. W. Spencer, "Fourier series
///          representation of the position of the sun", Search 2(5), 1971, for the distance.
/// @param day_of_year  1 to 366
Irradiance extraterrestrial_irradiance(int day_of_year);

/// The same from the distance in astronomical units.
Irradiance extraterrestrial_irradiance_at(double distance_au);

}  // namespace tenku
