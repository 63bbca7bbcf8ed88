/// Who finds the direct light of which sensors, with how many elements and how large maps.
#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "illuminance/daylight_source.h"
#include "illuminance/illuminate.h"
#include "illuminance/light_method.h"
#include "illuminance/pilots.h"
#include "illuminance/planned_region.h"
#include "illuminance/sensor.h"
#include "visibility/engines.h"

namespace tenku {

/// A region to be lit.
struct RegionWork {
  PlannedRegion told;
  std::vector<std::uint32_t> sensor;  ///< places among all sensors
  Pilots pilots;
  PartitionRequest partition;
  double weight = 1.0;  ///< of the error that a picture may have here; their mean is 1
};

/// Regions of the sensors, and for each what to do.
///
/// With one engine asked for, regions are only divided as its maps need it. Otherwise pilots are
/// lit by rays, which tells the time of the others; shared elements are tried on them, which tells
/// how many elements the tolerance needs and how far casters matter; some maps are drawn for the
/// region, which tells the time of those. The engine that is done sooner takes the region.
/// @param options  of the rays; its tolerance is that of all
/// @throws InputError     a method that does not suit the sensors
/// @throws ResourceError  as the engines do
std::vector<RegionWork> plan_light(const Sensors& sensors, const Engines& engines,
                                   const DaylightSource& source, const IlluminanceOptions& options,
                                   const LightMethod& method, Progress& progress);

}  // namespace tenku
