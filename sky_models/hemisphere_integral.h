/// Integrals over the sky vault.
#pragma once

#include <functional>

#include "core/units.h"
#include "core/vec3.h"
#include "sky_models/sky_model.h"

namespace tenku {

/// Integral of `f` over the solid angle of the upper hemisphere.
///
/// Gauss-Legendre in polar coordinates about `peak`, split where a circle about it touches the
/// horizon or passes the zenith. Meant for functions that are smooth but for a cusp or a lobe at
/// the peak (the sun) and a steep gradient at the horizon.
/// @param peak  unit vector, on or above the horizon
/// @param kink  unit normal of a plane through the observer across which `f` need not be smooth
/// Error    1e-9 relative for the CIE and Perez skies (docs/validation.md).
/// Cost     some 15,000 evaluations; twice that with a kink.
double hemisphere_integral(const std::function<double(Vec3)>& f, Vec3 peak, Vec3 kink = kZenith);

/// Horizontal diffuse illuminance under an unobstructed sky whose luminance peaks at `peak`.
Illuminance horizontal_illuminance(const SkyModel& sky, Vec3 peak);

/// Illuminance of a plane with normal `normal` under an unobstructed sky, no ground.
Illuminance plane_illuminance(const SkyModel& sky, Vec3 peak, Vec3 normal);

}  // namespace tenku
