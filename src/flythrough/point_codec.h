/// Points and light as the bytes of a record. Private to this module.
///
/// Columns of whole numbers, each as the difference from the point before in zigzag order, cut into
/// planes of one byte and deflated: neighbours in space differ little, and high bytes are zero.
#pragma once

#include <string>
#include <string_view>

#include "flythrough/point_store.h"

namespace tenku {

/// Chunks of points. The first `kChunkHead` bytes are not deflated.
/// @throws InputError from reading, if the bytes are not what their head says
std::string packed(const StoredPoints& points);
StoredPoints unpacked_points(std::string_view bytes);
ChunkInfo chunk_info(std::string_view bytes);

std::string packed(const PointLight& light);
PointLight unpacked_light(std::string_view bytes);

std::string packed(const StoreHeader& header);
StoreHeader unpacked_header(std::string_view bytes);

std::string packed(const StoreLighting& lighting);
StoreLighting unpacked_lighting(std::string_view bytes);

/// zlib stream (RFC 1950), level 6; the length of the original in front, 4 bytes.
std::string deflated(std::string_view bytes);
/// @throws InputError if the stream is damaged
std::string inflated(std::string_view bytes);

/// 0 for 2^-20 and less, else 1 + round(1024 (log2 v + 20)), at most 65535.
std::uint16_t log_code(double value);
double value_of_log_code(std::uint16_t code);

}  // namespace tenku
