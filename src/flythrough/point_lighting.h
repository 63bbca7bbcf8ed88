/// Sun, sky and reflected light on the points of a fly-through.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/progress.h"
#include "flythrough/stored_points.h"
#include "illuminance/light_plan.h"

namespace tenku {

/// How all points of a store are lit. Made once, and kept in its header: what depends on how long
/// things take must not differ between a run and its resumption.
struct PointLightPlan {
  /// Whether all points look in the same directions, one in each element of the sky; otherwise each
  /// sums slices of its own.
  bool is_shared = false;
  Engine engine = Engine::Rays;
  std::size_t elements = 0;  ///< 0: those asked for by hand
  std::size_t sun_directions = 0;
  int texels = 0;  ///< of shadow maps

  friend bool operator==(const PointLightPlan&, const PointLightPlan&) = default;
};

/// `slices`, or `shared rays 96 9 0`: engine, elements, directions on the sun, texels.
std::string text_of(const PointLightPlan& plan);
/// @throws InputError if it is no such text
PointLightPlan plan_of(const std::string& text);

struct PointLightOptions {
  double tolerance_pct = 2.0;  ///< of the light, as a picture's (`ViewRequest::tolerance_pct`)
  int bounces = 5;
  std::uint64_t seed = 1;
};

/// Finds which way is sooner done for points like these.
/// @param method  its engine and detail; elements by hand come with `source`
/// @throws as `plan_light`
PointLightPlan plan_point_light(const StoredPoints& points, const Engines& engines,
                                const DaylightSource& source, const PointLightOptions& options,
                                const LightMethod& method, Progress& progress);

/// Light of points.
///
/// Points that the film never shows as large as a pixel are lit less exactly, in proportion: a
/// pixel shows several of them. Skylight from slices is averaged with the points around on the same
/// surface, and reflected light is found for one point in a cell of some eight footprints and
/// shared, as `render_view` does both.
///
/// @param pixels  of each point where the camera is nearest (`pixels_at_closest`)
/// Same bits for any number of threads.
/// @throws Cancelled, ResourceError as `illuminate` and the engines
PointLight light_points(const StoredPoints& points, const std::vector<double>& pixels,
                        const Engines& engines, const DaylightSource& source,
                        const PointLightOptions& options, const PointLightPlan& plan,
                        Progress& progress);

/// Light of points under another sun and sky, from what they received under one.
///
/// The sun is asked for at each point. Skylight is found for one point in a cell of some eight
/// footprints, and its ratio to what that received before goes, blended over the cells around, to
/// the others: what hides the sky, which varies from point to point, is in the light before;
/// what the new sky changes varies slowly. Reflected light likewise, in cells of some 24
/// footprints.
///
/// Error    of skylight: where a cell holds points that see different parts of the sky. The sum
/// over
///          a cell is not affected.
/// @param before  their light under the other sky
/// @throws as `light_points`
PointLight relight_points(const StoredPoints& points, const PointLight& before,
                          const Engines& engines, const DaylightSource& source,
                          const PointLightOptions& options, const PointLightPlan& plan,
                          Progress& progress);

}  // namespace tenku
