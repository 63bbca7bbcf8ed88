/// Skylight of a picture, from point to point.
#pragma once

#include <cstdint>
#include <vector>

#include "illuminance/sensor.h"
#include "view/shading_points.h"

namespace tenku {

/// Points whose skylight scatters so much among the pixels around, on the same surface, that their
/// mean is not within the tolerance; in rising order.
/// @param tolerance  of the light of sun and sky there, or of a hundredth of its mean where it is
///                   less: a standard error
std::vector<std::uint32_t> scattered_sky(const ShadingPoints& points,
                                         const SensorIlluminance& light, double tolerance);

/// Averages of skylight over the pixels around, on the same surface.
void smooth_sky(const ShadingPoints& points, SensorIlluminance& light);

}  // namespace tenku
