/// Sun and sky on sensors from directions that all of them share.
#pragma once

#include <vector>

#include "core/progress.h"
#include "illuminance/daylight_source.h"
#include "illuminance/sensor.h"
#include "illuminance/shared_elements.h"
#include "visibility/visibility.h"

namespace tenku {

/// Direct light of sensors from directions that all share.
struct SharedLight {
  std::vector<double> sun_lux, sky_lux, sky_view;
  std::vector<double> scale_lux;  ///< of what may be wrong
};

/// @param elements  of the sky; may be none
/// @param sensors   lifted off their surfaces
/// @param wanted    as `SharedElements::light`
SharedLight shared_light(const Visibility& sky_engine, const Visibility& sun_engine,
                         const Sensors& sensors, const DaylightSource& source,
                         const SharedElements& elements, int sun_directions, Progress& progress,
                         const SharedElements::Wanted* wanted = nullptr);

}  // namespace tenku
