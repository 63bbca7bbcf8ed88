/// The sky of the same luminance everywhere.
#pragma once

#include "sky_models/sky_model.h"

namespace tenku {

/// Sky of uniform luminance.
///
/// Source   by definition; its horizontal illuminance is pi times its luminance.
class UniformSky : public SkyModel {
 public:
  /// @throws InputError if the luminance is negative or no number
  explicit UniformSky(Luminance everywhere);

  [[nodiscard]] Luminance luminance(Vec3 direction) const override;

 private:
  Luminance everywhere_;
};

}  // namespace tenku
