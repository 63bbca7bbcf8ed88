/// How far two pictures are apart, as a viewer sees them.
#pragma once

#include "view/image.h"

namespace tenku {

/// Mean absolute difference of the codes of all channels, in units of 1/255.
/// @param a, b  of one size
double mean_difference(const Image8& a, const Image8& b);

/// Mean structural similarity of the green channels, over windows of 8 by 8 pixels; 1 for a picture
/// with itself, and where it is smaller than a window.
///
/// Source   Z. Wang et al., "Image quality assessment: from error visibility to structural
///          similarity", IEEE TIP 13(4), 2004: K1 = 0.01, K2 = 0.03, L = 255.
double structural_similarity(const Image8& a, const Image8& b);

}  // namespace tenku
