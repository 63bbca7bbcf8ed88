/// The instants at which reflected sunlight is asked for.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "site/civil_time.h"
#include "site/location.h"
#include "sky_models/make_sky.h"

namespace tenku {

/// One instant with its sun. Without a clock where the sun was given by its angles.
struct SunMoment {
  std::optional<CivilTime> time;
  SolarDisc sun;
  double step_s = 0.0;  ///< from one instant of its day to the next; 0: an instant alone
  int day = 0;          ///< number of its day

  /// Whether it throws anything.
  bool is_up() const { return sun.direction.z > 0.0 && sun.normal_illuminance.value() > 0.0; }
};

/// The instants of a calendar day, on its clock, `step_min` minutes apart and one at noon.
/// @throws InputError if the step is not in 0.1 .. 720 minutes
std::vector<CivilTime> instants_of_day(const CivilTime& day, double step_min);

/// A day by its name.
struct NamedDay {
  std::string name;
  CivilTime noon;
};

/// March equinox, June solstice, September equinox and December solstice of the year of `time`: the
/// days whose noon, on the clock, is nearest to it by the sun's declination.
std::vector<NamedDay> turning_days(const CivilTime& time, const Location& site);

/// Sky of an instant.
using SkyAt = std::function<Sky(const CivilTime&)>;

/// The sun at each of the instants of one day; those at which it does not shine are left out.
/// @throws InputError as the sky does
std::vector<SunMoment> moments_of(const std::vector<CivilTime>& times, double step_min, int day,
                                  const SkyAt& sky_at);

}  // namespace tenku
