/// A value that sensors are held against, and on which side of it they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tenku {

/// On which side a sensor is. The codes are those of `.vtp` files.
enum class Decided : std::int8_t { Undecided = -1, No = 0, Yes = 1 };

constexpr std::string_view name_of(Decided decided) {
  return decided == Decided::Yes ? "yes" : decided == Decided::No ? "no" : "undecided";
}

/// `--decide`: is there as much light as this?
///
/// Of its total illuminance (`300lx`), or of its skylight without sun and reflected light as a
/// share of the unobstructed horizontal skylight (`27%sky`). The latter is the vertical sky
/// component where the sky is CIE overcast and the sensor faces sideways, the sky component of the
/// daylight factor where it faces up, and the sky view factor of a sensor that faces up where the
/// sky is uniform.
///
/// Source   P. Littlefair, "Site layout planning for daylight and sunlight" (BRE 209), appendix C:
/// the
///          vertical sky component; EN 17037:2018, table A.1: 300 lx.
struct DecisionThreshold {
  enum class Of { Total, Skylight };
  Of of = Of::Total;
  double value = 0.0;  ///< lux, or a share of 1

  /// The same in lux of the total or of the skylight.
  /// @param sky_lux  unobstructed horizontal skylight
  double lux(double sky_lux) const { return of == Of::Total ? value : value * sky_lux; }
};

/// Reads `300lx` or `27%sky`, blanks before the unit allowed.
/// @throws InputError  for any other form, and values not above 0, or above 100 %
DecisionThreshold decision_threshold(std::string_view text);

/// A value with its interval, against the threshold.
/// @param interval_lux  half-width
Decided decided_by(double value_lux, double interval_lux, double threshold_lux);

/// How many sensors are on which side.
struct DecisionCounts {
  std::size_t yes = 0, no = 0, undecided = 0;
};

DecisionCounts counts_of(const std::vector<Decided>& decided);

/// Such as `above 300lx: 12 yes, 30 no, 1 undecided`.
std::string in_words(std::string_view threshold, const DecisionCounts& counts);

}  // namespace tenku
