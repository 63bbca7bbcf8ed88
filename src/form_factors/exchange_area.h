/// How much two polygons exchange when nothing stands between them.
#pragma once

#include "form_factors/convex_polygon.h"

namespace tenku {

/// Integral of cos cos / (pi r^2) over two flat polygons: the area of either times its form factor
/// to the other, in m2.
///
/// Near polygons: the double integral of ln r along both outlines, the inner one in closed form,
/// the outer one by Gauss-Legendre where edges are apart and by a double exponential rule, cut
/// where the edges are nearest, elsewhere; so edges may touch. Far ones: Gauss-Legendre over both
/// areas, for there the terms of the contour integral cancel.
///
/// Source  E. M. Sparrow, "A new and simpler formulation for radiative angle factors", J. Heat
///         Transfer 85(2), 1963; H. Takahasi and M. Mori, Publ. RIMS 9(3), 1974, for the rule.
/// Valid   each polygon wholly on one side of the plane of the other, or touching it; they face
///         each other
/// Error   1e-9 relative, or 1e-14 of the product of the circumferences
double exchange_area(const ConvexPolygon& a, const ConvexPolygon& b);

}  // namespace tenku
