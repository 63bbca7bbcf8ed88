/// Intervals from sensors whose light is known.
#pragma once

#include <cstdint>
#include <vector>

namespace tenku {

/// The value below which a further one lies with a chance of at least 95 %.
/// @param sorted  ascending, not empty
double conformal_quantile(const std::vector<double>& sorted);

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
  static constexpr double kConfidence = 0.95;

  std::vector<std::uint32_t> sensor;  ///< places in the region
  std::vector<double> lux;            ///< direct light

  /// @param value, scale  of the pilots, in their order
  double interval_per_scale(const std::vector<double>& value,
                            const std::vector<double>& scale) const;
};

}  // namespace tenku
