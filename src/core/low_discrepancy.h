/// Owen-scrambled Sobol points: random each one, evenly spread together.
#pragma once

#include <cstdint>

namespace tenku {

/// Number of dimensions that `sobol_owen` knows; further ones are padded with fresh scrambles.
inline constexpr unsigned kSobolDimensions = 4;

/// Coordinate `dimension` of point `index` of a Sobol sequence under a nested uniform (Owen)
/// scramble chosen by `scramble`. Uniform in [0, 1); unbiased over scrambles.
///
/// Source   direction numbers: Joe and Kuo, "Constructing Sobol sequences with better
///          two-dimensional projections", SIAM J. Sci. Comput. 30, 2008, first four dimensions;
///          scramble: hash-based after Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4),
///          2020. Dimensions from four on take the four again under another shuffle and scramble.
double sobol_owen(std::uint32_t index, unsigned dimension, std::uint64_t scramble);

}  // namespace tenku
