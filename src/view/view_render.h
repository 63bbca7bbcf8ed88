/// A view of the lit scene.
#pragma once

#include <cstdint>
#include <vector>

#include "core/finding.h"
#include "core/progress.h"
#include "illuminance/planned_light.h"
#include "sky_models/sky_model.h"
#include "view/background.h"
#include "view/camera.h"
#include "view/image.h"
#include "view/mirror_method.h"

namespace tenku {

struct ViewRequest {
  PerspectiveView view;
  double tolerance_pct = 2.0;  ///< of the light on what is seen; see `RenderedView`
  int bounces = 5;
  std::uint64_t seed = 1;
  const ReflectionFinder* reflection = nullptr;  ///< in place of paths and `bounces`. Borrowed
  MirrorOptions mirrors;
  const Background* background = nullptr;  ///< seen in place of the sky. Borrowed
  LightMethod method;                      ///< its eye and polygons are those of the view
};

/// What the camera sees.
///
/// Every pixel is four rays; those that meet the same surface share one sensor. Direct light is
/// found for each sensor; reflected light, which varies slowly, for one sensor in a block of
/// pixels on the same surface, and is shared (ReflectedSharing; `share_by_pixels` where the request
/// has a finder). Light straight from lamps, with its shadows, is found for each sensor. Skylight
/// is averaged with the nearest pixels on the same surface.
///
/// Shape    every array [row][column], row 0 at the top.
/// Error    a pixel's standard error is held to the tolerance, not its four-fold: pictures are
///          seen, not measured; `error_lux` tells the 95 % interval.
struct RenderedView {
  Image luminance;                                 ///< linear RGB, cd/m2, the sky behind
  std::vector<double> illuminance_lux, error_lux;  ///< NaN where the sky is seen
  std::uint64_t rays = 0;
  std::size_t out_of_tolerance = 0;  ///< pixels for which the limit of effort came first
  std::vector<Finding> findings;
  double error_mean = 0.0;  ///< mean of error_lux over the pixels that have one
  std::vector<PlannedRegion> regions;
};

/// @param sky  for what is seen behind the scene; null: black
/// @throws InputError, Cancelled as `illuminate` and `PerspectiveCamera` do
RenderedView render_view(const ViewRequest& request, const Engines& engines,
                         const DaylightSource& source, const SkyModel* sky, Progress& progress);

/// What a picture would take.
struct ViewPlan {
  std::vector<PlannedRegion> regions;
  double reflection_s = 0.0;
};

/// The plan of `render_view`, with times and errors for either engine.
/// @throws as `render_view`
ViewPlan plan_view(const ViewRequest& request, const Engines& engines, const DaylightSource& source,
                   Progress& progress);

}  // namespace tenku
