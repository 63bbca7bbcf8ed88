/// The surface points that a picture needs beyond those that are stored already.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/progress.h"
#include "flythrough/point_splat.h"
#include "flythrough/stored_points.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// What one frame added.
struct GatheredFrame {
  StoredPoints points;
  std::uint64_t rays = 0;
  std::size_t surface_pixels = 0;  ///< that see a surface, whole or in part
  std::size_t glass_pixels = 0;    ///< of one in 64, those that look through panes
  std::size_t mirror_pixels = 0;   ///< that see a mirror
};

/// Finds points for the pixels that stored ones do not cover.
///
/// A ray through the middle of each pixel tells its true surface (RayVisibility::first_triangles).
/// Pixels whose neighbours see another surface are edges, and ask at each of their four samples. A
/// sample is covered if the point that the buffer shows there lies on the true surface: within half
/// its footprint of its plane, facing within 25 degrees of it, of its material. A pixel that is not
/// covered gets one point in its middle, an edge one of half its footprint at each sample that is
/// not. Where a disc of something nearer hangs over, nothing is added: it would not be seen.
///
/// Source   S. Takada, Y. Dobashi and T. Yamamoto, "A fast method for rendering townscape images
///          with skylight" (in Japanese), section 4.1: stored points are drawn first, and only what
///          they leave is asked for. There the polygons' colours tell the surface, and nothing
///          tells whether a stored point behind it shows through.
/// Order    by rows of the picture: the same points for any number of threads.
/// @throws Cancelled  if the user asks to stop
GatheredFrame gather_frame(const PerspectiveView& view, const SplatRule& rule,
                           const RayVisibility& rays, std::span<const SplatChunk* const> stored,
                           const Progress& progress);

}  // namespace tenku
