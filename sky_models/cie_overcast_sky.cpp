#include "sky_models/cie_overcast_sky.h"

#include <cmath>

#include "core/error.h"

namespace tenku {

CieOvercastSky::CieOvercastSky(Luminance zenith_luminance) : zenith_(zenith_luminance) {
  if (!(zenith_luminance.value() >= 0.0) || std::isinf(zenith_luminance.value())) {
    throw InputError("the zenith luminance must be zero or positive");
  }
}

Luminance CieOvercastSky::luminance(Vec3 direction) const {
  return direction.z < 0.0 ? Luminance(0.0) : ((1.0 + 2.0 * direction.z) / 3.0) * zenith_;
}

}  // namespace tenku
