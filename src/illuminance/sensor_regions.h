/// Sensors divided into parts that lie together.
#pragma once

#include <cstdint>
#include <vector>

#include "illuminance/sensor.h"

namespace tenku {

/// Places of the sensors of each part. Shape  [part][sensor].
using Parts = std::vector<std::vector<std::uint32_t>>;

/// The places 0 to `count` - 1.
std::vector<std::uint32_t> all_of(std::size_t count);

/// Halves the longest part across its longer side until all are at most `most_m` long, and few
/// sensors at most `alone_m` times the root of their number, or there are 64.
/// @param alone_m  the side of a map that one sensor takes in any case
Parts split_by_extent(const Sensors& sensors, double most_m, double alone_m);

/// A near and a far half, as seen from the eye.
Parts split_by_distance(const Sensors& sensors, Vec3 eye);

}  // namespace tenku
