/// A piece of the sky and the plane of a sensor.
#pragma once

#include "core/vec3.h"
#include "sky_models/sky_element.h"

namespace tenku {

/// Integral of the direction over a cell.
///
/// Source   with s the sine of the altitude: integral of sqrt(1 - s^2) ds, of the sine and the
///          cosine of the azimuth, of s ds.
Vec3 uniform_vector(const SkyCell& cell);

/// Where a cell lies to the plane of a sensor.
enum class Side { Front, Behind, Both };

/// @param normal  unit
Side side_of(const SkyCell& cell, Vec3 normal);

}  // namespace tenku
