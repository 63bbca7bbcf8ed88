/// How much of the light a mirror sends on.
#pragma once

#include "core/rgb.h"
#include "scene/material.h"

namespace tenku {

/// Specular reflectance at the given cosine of the angle of incidence: constant, by Fresnel's
/// formulas where the material has a `mirror_index`, or of a pane by `pane_reflectance`.
///
/// Source   what a clear pane of that index does not let through (see `pane_transmittance`). Where
///          `mirror` is another at normal incidence, as of coated glass, the part that is not
///          mirrored falls in the same proportion.
Rgb mirror_reflectance(const Material& material, double cos_incidence);

}  // namespace tenku
