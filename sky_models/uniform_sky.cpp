#include "sky_models/uniform_sky.h"

#include <cmath>

#include "core/error.h"

namespace tenku {

UniformSky::UniformSky(Luminance everywhere) : everywhere_(everywhere) {
  if (!(everywhere.value() >= 0.0) || std::isinf(everywhere.value())) {
    throw InputError("the luminance of a sky must be zero or positive");
  }
}

Luminance UniformSky::luminance(Vec3 direction) const {
  return direction.z < 0.0 ? Luminance(0.0) : everywhere_;
}

}  // namespace tenku
