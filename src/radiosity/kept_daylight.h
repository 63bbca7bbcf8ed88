/// Direct light that is found for one sky and taken over to others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "illuminance/daylight_source.h"
#include "illuminance/illuminate.h"
#include "illuminance/planned_light.h"
#include "illuminance/sensor.h"
#include "radiosity/sky_weights.h"
#include "visibility/engines.h"

namespace tenku {

/// How direct light is found.
struct DaylightMethod {
  const Engines& engines;
  const DaylightSource& source;
  IlluminanceOptions options;  ///< no bounces
  LightMethod method;
};

/// Sun and sky on the same sensors, one sky after another.
///
/// The integrator finds the light of the first sky. Then each sensor keeps which altitudes it sees
/// in slices of the sky, most of them where it sees any, as weights on directions. Under another
/// sky these sum up to so many times what they sum up to under the first, and so does its skylight:
/// the number of times varies little over what a sensor sees, so that it needs few slices. Sunlight
/// is found anew.
///
/// Error    of the number of times: half the difference between those of two halves of the slices,
///          pooled with those of the same plane. Sensors that so come out of
///          tolerance, and those that see the sky in fewer than kFewestSeeing slices, are found
///          anew. Few do: those that would under some clear skies keep four or 16 times as many
///          slices.
/// Cost     of another sky: some look-ups a slice, and the rays toward the sun.
class KeptDaylight {
 public:
  /// @param keeps  whether other skies follow; without it, all is found anew each time
  explicit KeptDaylight(bool keeps) : keeps_(keeps) {}

  /// @param sensors  the same ones each time
  /// @throws as `illuminate`
  IlluminanceResult light(const Sensors& sensors, const DaylightMethod& daylight,
                          Progress& progress);

  /// Sensors that the last call has found anew.
  std::size_t found_anew() const { return found_anew_; }
  std::size_t bytes() const { return weights_ ? weights_->bytes() : 0; }

  static constexpr int kFewestSeeing = 6;  ///< slices

 private:
  /// What a sensor sees of the sky, beside its weights.
  struct Seen {
    std::array<double, SkyWeights::kHalves> first_lux{};  ///< of both halves under the first sky
    std::uint32_t plane = 0;                              ///< equal for sensors of one plane
    std::uint8_t fineness = 0;
    bool is_enough = false;
  };
  /// What another sky gives, in times of the first.
  struct Times {
    double mean = 0.0, variance = 0.0;  ///< the latter in parts of the mean squared
    bool is_known = false;
  };

  void keep(const Sensors& sensors, const DaylightMethod& daylight, IlluminanceResult first,
            Progress& progress);
  struct Looked {
    SkyWeights::Row row;
    bool is_enough = false;
  };
  Looked look(const Sensors& sensors, std::size_t i, const DaylightMethod& daylight) const;
  void keep_looks(const Sensors& sensors, std::span<const std::uint32_t> which,
                  const DaylightMethod& daylight, Progress& progress);
  Times times(std::size_t sensor, std::span<const float> luminance) const;
  std::vector<std::uint32_t> rough_in_trials(const IlluminanceOptions& options) const;
  std::vector<Times> times_of_all(std::span<const float> luminance) const;
  IlluminanceResult taken_over(const Sensors& sensors, const DaylightMethod& daylight,
                               Progress& progress);
  void find_anew(const Sensors& sensors, const DaylightMethod& daylight, Progress& progress,
                 IlluminanceResult& result);

  bool keeps_;
  std::optional<SkyWeights> weights_;  ///< once anything is kept
  std::vector<Seen> seen_;             ///< [sensor]
  std::uint32_t planes_ = 0;
  std::vector<float> first_luminance_;  ///< [node], of all nodes
  SensorIlluminance first_;
  double first_horizontal_lux_ = 0.0;
  std::size_t found_anew_ = 0;
};

}  // namespace tenku
