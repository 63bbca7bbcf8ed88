#include "beams/mirror_reflectance.h"

#include "visibility/ray_visibility.h"

namespace tenku {

Rgb mirror_reflectance(const Material& material, double cos_incidence) {
  if (!(material.mirror > 0.0) && material.is_glass()) {
    return Rgb::grey(pane_reflectance(material, cos_incidence));
  }
  const Rgb upright = material.mirror * material.mirror_tint;
  if (!(material.mirror_index > 0.0)) return upright;
  Material pane;
  pane.index = material.mirror_index;
  const double rest = pane_transmittance(pane, cos_incidence) / pane_transmittance(pane, 1.0);
  return {1.0 - (1.0 - upright.r) * rest, 1.0 - (1.0 - upright.g) * rest,
          1.0 - (1.0 - upright.b) * rest};
}

}  // namespace tenku
