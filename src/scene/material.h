/// What a surface does to light.
#pragma once

#include <string>

#include "core/rgb.h"

namespace tenku {

/// Opaque diffuse reflector, or glass, or a mirror, or a source.
///
/// Valid    every channel of `reflectance` in [0, 1); `mirror` and `transmittance` in [0, 1];
///          `index` 0 (no glass) or at least 1; readers refuse anything else.
struct Material {
  std::string name;
  Rgb reflectance{0.3, 0.3, 0.3};  ///< diffuse, both sides
  double mirror = 0.0;             ///< specular reflectance at normal incidence, its luminance
  Rgb mirror_tint{1.0, 1.0, 1.0};  ///< specular reflectance by colour over `mirror`
  double mirror_index = 0.0;       ///< a pane of this index mirrors: more at glancing incidence
  double index = 0.0;              ///< refractive index of a clear pane; 0 where it is no glass
  double transmittance = 0.0;      ///< of a pane at normal incidence; 0 where `index` tells it
  Rgb emission_lm_m2{};            ///< exitance of its own, both sides

  bool is_glass() const { return index > 0.0 || transmittance > 0.0; }
};

}  // namespace tenku
