/// The form factor of a polygon as a point sees it.
#pragma once

#include "form_factors/convex_polygon.h"

namespace tenku {

/// Form factor from a small surface at the origin, facing along z, to a polygon above its horizon
/// (z >= 0) before which nothing stands.
///
/// Source  J. H. Lambert, "Photometria", 1760: the sum over the edges of the angle that an edge
///         spans, times the cosine between z and the normal of the plane through edge and origin,
///         over 2 pi.
/// Error   rounding, some 1e-16 in all.
double lambert_form_factor(const ConvexPolygon& polygon);

}  // namespace tenku
