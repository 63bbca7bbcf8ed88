/// The traditional overcast sky.
#pragma once

#include "sky_models/sky_model.h"

namespace tenku {

/// Luminance of the traditional CIE overcast sky: (1 + 2 sin altitude) / 3 of the zenith's.
///
/// Source   P. Moon and D. E. Spencer, "Illumination from a non-uniform sky", Illum. Eng. 37,
///          1942; ISO 15469:2004, section 4, sky 16. Horizontal illuminance 7 pi / 9 of the zenith
///          luminance.
class CieOvercastSky : public SkyModel {
 public:
  /// @throws InputError if the zenith luminance is negative or no number
  explicit CieOvercastSky(Luminance zenith_luminance);

  [[nodiscard]] Luminance luminance(Vec3 direction) const override;

 private:
  Luminance zenith_;
};

}  // namespace tenku
