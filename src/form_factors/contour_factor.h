/// Form factor of a polygon that nothing hides, in closed form.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/vec3.h"

namespace tenku {

/// From a small surface to a polygon: the part in front of the surface counts, whichever way the
/// polygon faces.
///
/// Source  J. H. Lambert, "Photometria", 1760, by way of D. R. Baum, H. E. Rushmeier, J. M. Winget,
///         "Improving radiosity solutions through the use of analytically determined form-factors",
///         SIGGRAPH 1989: the sum over the edges of the angle each subtends, along the normal.
/// Error   rounding: about 1e-15 absolutely.
/// @param normal   unit
/// @param polygon  convex and flat, of at most kMostContourCorners corners
/// @return         0 to 1
double contour_factor(Vec3 point, Vec3 normal, std::span<const Vec3> polygon);

/// The same of a polygon of any shape, holes too, that lies wholly in front of the surface.
/// @param edges  all in the same sense about it, in any order
double contour_factor_of_edges(Vec3 point, Vec3 normal, std::span<const std::array<Vec3, 2>> edges);

inline constexpr std::size_t kMostContourCorners = 16;

}  // namespace tenku
