/// The choices that a user has between ways to find light.
#pragma once

#include <optional>
#include <string_view>

#include "core/vec3.h"
#include "illuminance/seen_polygons.h"

namespace tenku {

/// `--engine auto|rays|shadow-maps`.
enum class EngineChoice { Auto, Rays, ShadowMaps };

/// @throws InputError for any other name
EngineChoice engine_named(std::string_view name);

/// `--lod off|paper|budget`: how much of the model and the sky is taken into account.
enum class Detail { Off, Paper, Budget };

/// @throws InputError for any other name
Detail detail_named(std::string_view name);

/// `--reflection auto|radiosity|paths`: who finds the light between surfaces. `Auto`: radiosity in
/// what is no longer than 60 m and has no more than 20,000 triangles, such as a room or a
/// courtyard.
enum class Reflection { Auto, Radiosity, Paths };

/// @throws InputError for any other name
Reflection reflection_named(std::string_view name);

/// How direct light is found.
struct LightMethod {
  EngineChoice engine = EngineChoice::Auto;
  Detail detail = Detail::Budget;
  /// Above zero: the sensors are a picture, and regions lit by maps are good enough if their mean
  /// absolute error is within 0.3 of this, in percent of the unobstructed light, or of four times
  /// the mean light of the region if that is less.
  double picture_tolerance_pct = 0.0;
  double mu = 1.0;                         ///< `Detail::Paper`: threshold of PaperDetail
  std::optional<Vec3> eye;                 ///< of a picture: its regions lie from near to far
  const SeenPolygons* polygons = nullptr;  ///< of a picture; needed for `Detail::Paper`. Borrowed
  bool is_predicted = false;               ///< times are estimated even where there is no choice
};

}  // namespace tenku
