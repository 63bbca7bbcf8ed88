/// Form factors from areas that are known and the parts of them that lines find to be seen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "form_factors/form_factor.h"
#include "form_factors/point_view.h"

namespace tenku {

/// A seen side on the disc.
struct SidePart {
  double area = 0.0;              ///< whatever stands before it, in parts of the disc
  double low = 1.0, high = -1.0;  ///< range of y
  double whole = 0.0;             ///< length on all lines, whatever stands before it
  double visible = 0.0;           ///< of `whole`
};

/// A row of the matrix: of each side the visible part of its lengths, times its area. What is
/// wholly visible is exact.
///
/// Between lines  a side that no line meets is seen as those beside it on its sheet are. A sheet
/// that
///                is less high than the distance of lines is met with a chance; it counts for more
///                where it is met, so that the mean over many points is right.
/// Sum            visible lengths of all sides and what is left of the disc make it whole, so that
///                the row of a point inside closed surfaces adds up to 1. So must areas; what they
///                lack is shared out among sides that are seen in part, and what is left of the
///                disc.
///
/// @param part   [seen]
/// @param sheet  [seen], as `sheets_of`
/// @param step   distance of lines
/// @param unit   form factor of one unit of length
FormFactorRow row_of_parts(const PointView& view, std::span<const SidePart> part,
                           std::span<const std::uint32_t> sheet, double step, double unit);

}  // namespace tenku
