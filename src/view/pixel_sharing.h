/// Slowly varying light of a picture from that of few of its points.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "illuminance/sensor.h"
#include "view/shading_points.h"

namespace tenku {

/// Finds `reflected_rgb` and `error_lux` of some points of a picture, in the order given.
using PixelLightFinder = std::function<SensorIlluminance(std::span<const std::uint32_t> points)>;

/// Fills the reflected light of all points of a picture, and adds to `error_lux`.
///
/// Light is found for points 8 pixels apart on each surface. Where one differs from what those
/// around it tell of its place by more than the tolerance, points twice as near are found, and so
/// on to every pixel: along contacts and creases, and where light falls on a part of a surface
/// only. Along the borders of surfaces they are 2 pixels apart anyway. What those around tell is
/// the value of the plane that fits the nearest twelve best, the nearer the more: it follows a
/// slope to the edge of a surface, where a mean would lag behind.
///
/// Error    of a point: the mean of those around, and how far they lie off the plane.
/// Same bits for any number of threads.
/// @param tolerance  of each value, or of a hundredth of the mean where the value is less
/// @return  points that those around still do not tell of, in rising order
std::vector<std::uint32_t> share_by_pixels(const ShadingPoints& points, double tolerance,
                                           const PixelLightFinder& find, SensorIlluminance& light);

}  // namespace tenku
