/// Who finds the direct light of which sensors, with how many elements and how large maps.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "illuminance/daylight_source.h"
#include "illuminance/illuminate.h"
#include "illuminance/planned_region.h"
#include "illuminance/seen_polygons.h"
#include "illuminance/sensor.h"
#include "illuminance/shared_elements.h"
#include "visibility/engines.h"

namespace tenku {

/// `--engine auto|rays|shadow-maps`.
enum class EngineChoice { Auto, Rays, ShadowMaps };

/// @throws InputError for any other name
EngineChoice engine_named(std::string_view name);

/// `--lod off|paper|budget`: how much of the model and the sky is taken into account.
enum class Detail { Off, Paper, Budget };

/// @throws InputError for any other name
Detail detail_named(std::string_view name);

/// How direct light is found.
struct LightMethod {
  EngineChoice engine = EngineChoice::Auto;
  Detail detail = Detail::Budget;
  /// Above zero: the sensors are a picture, and regions lit by maps are good enough if their mean
  /// absolute error is within 0.3 of this, in percent of the unobstructed light.
  double picture_tolerance_pct = 0.0;
  double mu = 1.0;                         ///< `Detail::Paper`: threshold of PaperDetail
  std::optional<Vec3> eye;                 ///< of a picture: its regions lie from near to far
  const SeenPolygons* polygons = nullptr;  ///< of a picture; needed for `Detail::Paper`. Borrowed
  bool is_predicted = false;               ///< times are estimated even where there is no choice
};

/// Sensors whose direct light is known well beforehand, and what they tell of all.
///
/// What a method gives for them less what they truly receive, by a scale that the method knows for
/// every sensor (here: the light along the outlines that it met), is sorted. The value below which
/// 95 % of these ratios lie, times the scale of another sensor, is its 95 % interval whatever the
/// cause of the error: elements, texels, or casters left out.
///
/// Source   split conformal prediction: H. Papadopoulos et al., "Inductive confidence machines for
///          regression", ECML 2002; J. Lei et al., "Distribution-free predictive inference for
///          regression", J. Am. Stat. Assoc. 113, 2018.
/// Error    sensors drawn as the pilots were lie inside with a chance of at least 95 %, of
///          n / (n + 1) of the share that the sorting gives.
struct Pilots {
  std::vector<std::uint32_t> sensor;  ///< places in the region
  std::vector<double> lux;            ///< direct light

  /// @param value, scale  of the pilots, in their order
  double interval_per_scale(const std::vector<double>& value,
                            const std::vector<double>& scale) const;
};

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

/// The sensors of a region, in its order.
Sensors sensors_of(const Sensors& all, const std::vector<std::uint32_t>& chosen);

/// Moved off their surfaces, as engines want them.
Sensors lifted(Sensors sensors, double lift_m);

/// Direct light of sensors from directions that all share.
struct SharedLight {
  std::vector<double> sun_lux, sky_lux, sky_view;
  std::vector<double> scale_lux;  ///< of what may be wrong
};
SharedLight shared_light(const Visibility& sky_engine, const Visibility& sun_engine,
                         const Sensors& lifted_sensors, const DaylightSource& source,
                         const SkyPartition& partition, int sun_directions, Progress& progress,
                         const SharedElements::Wanted* wanted = nullptr);

}  // namespace tenku
