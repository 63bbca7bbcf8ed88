/// Points cut into chunks that are compact in space.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "flythrough/stored_points.h"

namespace tenku {

/// Halves across the longest side until no part has more than `most` points; within each part the
/// points follow Morton's curve, so that neighbours in the list are neighbours in space.
/// @return  places among the points. Shape [part][point]
std::vector<std::vector<std::uint32_t>> cut_by_space(const StoredPoints& points, std::size_t most);

}  // namespace tenku
