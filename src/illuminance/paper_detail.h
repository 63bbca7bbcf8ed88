/// The level of detail of the townscape paper: which elements a polygon needs.
#pragma once

#include <cstddef>
#include <vector>

#include "illuminance/seen_polygons.h"
#include "illuminance/shared_elements.h"

namespace tenku {

/// For each polygon the elements in the order of what they give it unobstructed; it needs the first
/// j for which alpha R_p(j) M_p / d_p^2 < mu, with R_p(j) the sum of the others. The others are
/// added unobstructed, as ambient light.
///
/// Source   S. Takada, Y. Dobashi and T. Yamamoto, "A fast method for rendering townscape images
///          with skylight" (in Japanese), equations 4 to 6. The paper leaves alpha open; here it is
///          1 / (unobstructed horizontal illuminance of the sky), and M_p / d_p^2 counts pixels, so
///          that mu is an error summed over the pixels of a polygon, 1 for one pixel wholly wrong.
/// @throws InputError  mu not a number above 0
SharedElements::Wanted paper_detail(const SharedElements& elements, const SeenPolygons& polygons,
                                    double mu);

}  // namespace tenku
