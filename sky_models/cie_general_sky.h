#pragma once

#include "sky_models/sky_model.h"

namespace tenku {

/// Luminance of the sky according to the CIE Standard General Sky.
///
/// Fifteen standard skies, from overcast (1) through uniform (5) to clear (12), each the product
/// of a gradation from zenith to horizon and an indicatrix of scattering around the sun.
/// Skylight only: the solar disc is not part of the model.
///
/// Source   ISO 15469:2004 / CIE S 011/E:2003, table 1; S. Darula and R. Kittler, "CIE General
///          Sky Standard Defining Luminance Distributions", eSim 2002.
/// Frame    x east, y north, z up; directions are unit vectors from the observer to the sky.
/// Valid    sun above the horizon. The standard gives relative luminance; the absolute level is
///          the caller's, as zenith luminance.
/// Threads  immutable after construction; may be shared.
class CieGeneralSky : public SkyModel {
 public:
  /// Gradation (a, b) and indicatrix (c, d, e), in the notation of the standard. Dimensionless,
  /// but for d, which is per radian.
  struct Coefficients {
    double a, b, c, d, e;
  };

  /// @param type              1 to 15, the row of table 1
  /// @param sun               unit vector to the centre of the sun, above the horizon
  /// @param zenith_luminance  positive
  /// @throws InputError       if an argument is outside its range
  CieGeneralSky(int type, Vec3 sun, Luminance zenith_luminance);

  /// Luminance of the sky in `direction`; zero below the horizon.
  [[nodiscard]] Luminance luminance(Vec3 direction) const override;

 private:
  double indicatrix(Vec3 direction) const;
  double relative_luminance(Vec3 direction) const;

  Coefficients k_;
  double across_;  ///< exp(d pi / 2), at right angles to the sun
  Vec3 sun_;
  Luminance scale_;  ///< luminance at relative luminance 1
};

}  // namespace tenku
