/// A grid of heights as few triangles that stay near enough to it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/vec3.h"

namespace tenku {

/// Heights at the crossings of a grid, which may be turned or bent.
///
/// Shape    `points` [row][column], row-major.
/// Frame    z up; NaN where there is no height.
struct HeightGrid {
  std::size_t rows = 0, columns = 0;
  std::span<const Vec3> points;
};

/// How far from the grid the triangles may be about a point, m. It is asked about corners; what
/// lies up to `reach` grid steps away goes with them.
using AllowedHeight = std::function<double(Vec3 point, std::size_t reach)>;

/// Right triangles with corners in points of the grid; counter-clockwise seen from above. None
/// covers a point without height.
///
/// Source   W. Evans, D. Kirkpatrick, G. Townsend, "Right-triangulated irregular networks",
///          Algorithmica 30, 2001
/// Error    no point of the grid is farther above or below its triangle than is allowed there: the
///          heights by which halves of triangles leave the whole are summed over all halvings.
/// @return  indices into `points`
std::vector<std::array<std::uint32_t, 3>> thin_grid(const HeightGrid& grid,
                                                    const AllowedHeight& allowed);

}  // namespace tenku
