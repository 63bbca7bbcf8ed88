/// How large a point is ever shown.
#pragma once

#include <vector>

#include "flythrough/camera_path.h"
#include "flythrough/point_splat.h"
#include "flythrough/stored_points.h"

namespace tenku {

/// Width of each point's footprint in pixels where the camera comes nearest to it, as long as it is
/// drawn: nearer than `SplatRule::coarsest_pixels` allows, finer points have taken its place.
///
/// Source   S. Takada, Y. Dobashi and T. Yamamoto, "A fast method for rendering townscape images
///          with skylight" (in Japanese), section 4.2: a point is lit as exactly as the nearest
///          frame needs it.
/// Frame    distances are from the eye, whatever the direction of view.
/// @return  [point], in (0, `coarsest_pixels`]
std::vector<double> pixels_at_closest(const StoredPoints& points, const CameraPath& path,
                                      const SplatRule& rule);

}  // namespace tenku
