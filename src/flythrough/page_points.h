/// Points packed for a web page: at most 20 bytes each before they are deflated.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/rgb.h"
#include "core/vec3.h"
#include "flythrough/point_store.h"

namespace tenku {

/// Neighbouring points whose places are counted from one corner.
struct PageBlock {
  std::size_t points = 0;
  Vec3 origin, step;  ///< place = origin + step * code, code 0..65535 on each axis
  float finest_m = 0.0F;
};

/// Geometry of a chunk for a page.
struct PagePoints {
  std::vector<PageBlock> blocks;
  /// zlib stream. Shape: six columns of 16 bits [x, y, z, footprint, normal u, normal v][point],
  /// each as differences modulo 2^16, the low bytes first and then the high ones; then four columns
  /// of bytes, the borders (`PointBorders::code`).
  std::string bytes;
};

/// Footprint: 2 k + 1 at an edge, else 2 k, with k = 1 + round(512 (log2 metres + 20)), 0..32767.
/// Normal: the octahedron's plane, signed 16 bits each.
///
/// Source   octahedral normals: Q. Meyer et al., "On floating-point normal vectors", EGSR 2010.
/// Error    places by half a step, footprints by 0.07 %, normals by 1e-4 radians.
PagePoints page_points(const StoredPoints& points);

/// Colours as shared-exponent codes in a zlib stream, four columns of bytes.
std::string page_colours(const std::vector<Rgb>& colours);

/// Three mantissas of 9 bits with one exponent of 5, in cd/m2; clipped at 65408 cd/m2.
///
/// Source   OpenGL extension EXT_texture_shared_exponent.
/// Error    of each channel 0.2 % of the largest.
std::uint32_t shared_exponent_code(Rgb colour);
Rgb colour_of_shared_exponent(std::uint32_t code);

/// Stands for "nothing is here" among such codes; no colour has it.
inline constexpr std::uint32_t kNoColourCode = 0xffffffffU;

}  // namespace tenku
