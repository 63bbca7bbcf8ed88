/// Light with edges or creases, in the pixels that one runs through.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "illuminance/sensor.h"
#include "view/pixel_paths.h"
#include "view/shading_points.h"

namespace tenku {

/// The points of a picture and how they came about: borrowed.
struct PixelRays {
  const ShadingPoints& points;
  const PixelPaths& paths;  ///< those that made the points
  const RayVisibility& rays;
};

/// Adds reflected light to places on surfaces.
/// @param point  that each place belongs to, index into the picture's points
using PlaceLightFinder = std::function<void(
    const Sensors& places, std::span<const std::uint32_t> point, SensorIlluminance& values)>;

/// Points whose reflected light differs from that of a neighbour on the same surface by more than
/// the tolerance, in rising order.
/// @param tolerance  of each value, or of a hundredth of the mean where the value is less
std::vector<std::uint32_t> points_on_edges(const ShadingPoints& points,
                                           const SensorIlluminance& light, double tolerance);

/// Gives those of the chosen points that several rays of a pixel met the mean reflected light of
/// the places where they did, with its error.
void take_means_of_rays(const PixelRays& pixels, std::span<const std::uint32_t> chosen,
                        const PlaceLightFinder& find, SensorIlluminance& light);

}  // namespace tenku
