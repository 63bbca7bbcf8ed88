/// Sky, sun and visibility into lux, to the tolerance asked for.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/finding.h"
#include "core/progress.h"
#include "illuminance/daylight_source.h"
#include "illuminance/decision.h"
#include "illuminance/error_budget.h"
#include "illuminance/planned_region.h"
#include "illuminance/reflected_sharing.h"
#include "illuminance/sensor.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// Finds the light between surfaces other than by paths: fills `reflected_lux` and `reflected_rgb`
/// of sensors whose direct light is in `values`, and adds to `error_lux`.
struct ReflectionFinder {
  using Finder =
      std::function<void(const Sensors& sensors, SensorIlluminance& values, Progress& progress)>;
  Finder all;
  /// The same in two parts for a picture: for all of its points the light straight from lamps is
  /// added, more carefully where a shadow ends;
  Finder lamps, lamps_on_edges;
  /// then, for some of them, what varies slowly. Light of lamps counts as direct light here.
  /// @param mean_of  so many values are to be averaged: each may have the noise of one of them
  std::function<void(const Sensors& places, int mean_of, SensorIlluminance& values,
                     Progress& progress)>
      without_lamps;
};

struct IlluminanceOptions {
  double tolerance_pct = 2.0;
  int bounces = 5;  ///< diffuse ones, of `reflected`; 0 for none
  std::uint64_t seed = 1;
  double floor_share = 0.001;  ///< of the unobstructed illuminance: lower values are held to it
  int first_slices = 16;       ///< of the sky, a sensor; a power of two
  int most_slices = 4096;      ///< of the sky, a sensor
  int most_paths = 65536;      ///< of reflected light, a sensor
  /// Sensors nearer to each other than this share reflected light (ReflectedSharing); 0: each has
  /// its own.
  double share_reflected_m = 0.0;
  /// Direct light already known, in lux, and the sky view with it [sensor]: only the reflected
  /// light is found, to the tolerance of the sum. Borrowed.
  struct KnownDirect {
    std::vector<double> lux, sky_view;
  };
  const KnownDirect* known_direct = nullptr;
  const ReflectionFinder* reflection = nullptr;  ///< in place of paths. Borrowed
  bool lamps_apart = false;  ///< light straight from lamps is left to `add_lamp_light`
  bool by_slices = false;    ///< even where `source.elements` is given
  /// Sensors are only to be told from this value: one whose interval is clear of it is refined no
  /// further, however wide that is; the others reach the tolerance. Where light comes in parts
  /// (`reflection`, `share_reflected_m`, shadow maps) decisions on the total save nothing.
  std::optional<DecisionThreshold> decide;
};

/// What came out, and what it took.
struct IlluminanceResult {
  SensorIlluminance values;
  std::uint64_t rays = 0;
  /// [sensor], whether it is less exact than the tolerance: its interval is wider, or the limit of
  /// effort came before the budget was met.
  /// Sensors that are decided are never missed.
  std::vector<std::uint8_t> is_missed;
  std::size_t out_of_tolerance = 0;  ///< how many of them
  std::vector<Decided> decided;      ///< [sensor], if there was something to decide
  std::vector<Finding> findings;
  /// What was planned and what became of it, where the engine was for the plan to choose.
  std::vector<PlannedRegion> regions;
};

/// Holds the totals of all sensors against the threshold, unless it is on skylight and held against
/// already.
void decide_totals(const DaylightSource& source, const IlluminanceOptions& options,
                   IlluminanceResult& result);

/// Illuminance of every sensor. Rays are spent where the interval is still too wide. Where
/// `source.elements` is given, they settle the error of the skylight; sensors with an interval
/// wider than the tolerance are then out of tolerance.
/// Same bits for any number of threads.
/// @throws InputError  tolerance not in (0, 100], bounces not in 0..100, a share of a sky that is
/// not
///                     there to decide on
/// @throws Cancelled   if the user asks to stop
IlluminanceResult illuminate(const Sensors& sensors, const RayVisibility& rays,
                             const DaylightSource& source, const IlluminanceOptions& options,
                             Progress& progress);

/// Whether a sensor sees no sky and gets no light.
bool is_dark(const SensorIlluminance& values, std::size_t sensor);

/// Sensors that nothing reaches although there is light outside.
void find_dark_sensors(const Sensors& sensors, const SensorIlluminance& values,
                       std::vector<Finding>& findings);

/// Sensors that stand on a surface other than theirs: on an edge, or at the foot of a wall. Whether
/// they are in front of it or behind it only rounding tells.
std::optional<Finding> sensors_on_edges(const Sensors& sensors, const RayVisibility& rays);

/// Counts the sensors out of tolerance, and says so in the findings.
void tell_missed(IlluminanceResult& result);

/// Adds the reflected light to a result of direct light: that of the representatives, calculated
/// as `options` say, and of the others from them.
/// @throws as `illuminate`
void add_shared_reflection(const ReflectedSharing& sharing, const RayVisibility& rays,
                           const DaylightSource& source, const IlluminanceOptions& options,
                           Progress& progress, IlluminanceResult& result);

/// Adds the reflected light to a result of direct light, shared where `options` say so.
/// @throws as `illuminate`
void add_reflection(const Sensors& sensors, const RayVisibility& rays, const DaylightSource& source,
                    const IlluminanceOptions& options, Progress& progress,
                    IlluminanceResult& result);

}  // namespace tenku
