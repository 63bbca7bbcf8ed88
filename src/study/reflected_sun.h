/// Sunlight thrown by the mirrors of a scene, over some instants.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "beams/sun_overlaps.h"
#include "beams/sun_throw.h"
#include "core/progress.h"
#include "study/lit_scene.h"
#include "study/sun_moments.h"

namespace tenku {

/// What is asked for.
struct ReflectionOptions {
  ThrowOptions how;
  bool adds_overlaps = true;  ///< else every thrown polygon is told by itself
};

/// What a panel did over all instants.
struct PanelSum {
  std::size_t instants = 0;  ///< at which it threw light on something
  std::size_t first = 0, last = 0;
  double minutes = 0.0;
  double thrown_lmh = 0.0;  ///< lumen hours that it mirrored; of an instant alone 0
  double most_lm = 0.0;     ///< lumen at its strongest instant
  double most_lux = 0.0;    ///< on any surface, of this panel alone
  double most_reflectance = 0.0;
  double least_lit = 1.0;  ///< share of the light that reaches it, at its darkest instant
};

/// A time during which a panel throws light on an object.
struct SunWindow {
  std::uint32_t panel = 0, object = 0;
  std::size_t first = 0, last = 0;  ///< instants
  double most_lux = 0.0, most_m2 = 0.0;
};

/// All of it.
struct ReflectedSun {
  std::vector<SunMoment> moments;
  std::vector<MirrorPanel> panels;
  std::vector<std::string> panel_names;        ///< [panel]
  std::vector<std::vector<SunPatch>> patches;  ///< [moment]
  std::vector<PanelSum> sums;                  ///< [panel]
  std::vector<SunWindow> windows;              ///< by panel, object, time
  double started_lm = 0.0, landed_lm = 0.0, sky_lm = 0.0, unfollowed_lm = 0.0;  ///< of all instants
  double most_lux = 0.0;  ///< of all together, on any polygon of 0.1 m2 or more

  /// Light that the divided beams have lost or won, of what they began with.
  double balance_error() const;
  std::size_t polygon_count() const;
  /// Half a step before the first and after the last of some instants.
  std::pair<std::string, std::string> window_text(std::size_t first, std::size_t last) const;
  std::string time_text(std::size_t moment) const;
};

/// Name of each panel: its object's id, with `#1`, `#2` ... where the object has several.
std::vector<std::string> names_of(const std::vector<MirrorPanel>& panels, const Scene& scene);

/// @throws InputError if nothing in the scene mirrors
/// Cost     panels times instants times what lies in their beams; 0.1 ms a panel in a city.
ReflectedSun reflected_sun(const LitScene& lit, std::vector<SunMoment> moments,
                           const ReflectionOptions& options, Progress& progress);

/// What should be told of a result.
std::vector<Finding> findings_of(const ReflectedSun& sun, const ReflectionOptions& options);

}  // namespace tenku
