/// One line of a plan: sensors that are lit together, and how.
#pragma once

#include <cstddef>
#include <limits>
#include <string>

#include "core/vec3.h"

namespace tenku {

/// Who finds the direct light of a region.
enum class Engine { Rays, ShadowMaps };

constexpr const char* name_of(Engine engine) {
  return engine == Engine::Rays ? "rays" : "shadow-maps";
}

/// What was chosen for a region and what it was expected to cost, beside what it did cost.
///
/// Units    seconds of clock time of the direct light; `..._lux` are means over the region of the
///          half-width of the 95 % interval. Not a number: not estimated, or not carried out.
struct PlannedRegion {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  Engine engine = Engine::Rays;
  std::string why;
  std::size_t sensors = 0;
  Vec3 middle{};  ///< of the sensors, local frame
  /// Whether all sensors look in the same directions, one in each element; otherwise each has its
  /// own way (SensorSky, ElementSky). Maps are always shared.
  bool is_shared = false;
  /// Whether sensors may take their skylight from those around; how many did.
  bool may_interpolate = false;
  std::size_t interpolated = 0;
  std::size_t elements = 0, sun_directions = 0;
  int texels = 0;  ///< along a side of a map
  double texel_m = 0.0;
  double wanted_texel_m = 0.0;                               ///< by the tolerance
  double reach_m = std::numeric_limits<double>::infinity();  ///< farther casters are left out
  double left_out_lux = 0.0;  ///< what they could add, at 95 % of the pilots at most
  /// Predicted: rays for each sensor by itself, rays in shared directions, maps.
  double rays_s = kUnknown, shared_s = kUnknown, maps_s = kUnknown;
  double predicted_error_lux = kUnknown;
  double measured_s = kUnknown, measured_error_lux = kUnknown;

  double predicted_s() const {
    return engine == Engine::ShadowMaps ? maps_s : is_shared ? shared_s : rays_s;
  }
};

}  // namespace tenku
