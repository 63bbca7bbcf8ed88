/// The range of a colour bar or an axis, with round ends and round ticks.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace tenku {

/// Scale from a low to a high value, linear or logarithmic.
///
/// Valid    low < high; both positive if logarithmic.
struct ValueScale {
  double low = 0.0, high = 1.0;
  bool logarithmic = false;

  /// Where `value` lies: 0 at `low`, 1 at `high`, clipped to that range.
  [[nodiscard]] double position_of(double value) const;

  /// Inverse of `position_of` for `position` in 0..1.
  [[nodiscard]] double value_at(double position) const;

  /// Round values within the scale, its ends included where they are round: about `wanted` of
  /// them; decades (with 2 and 5 where there is room) if logarithmic.
  [[nodiscard]] std::vector<double> ticks(int wanted = 6) const;
};

/// Round scale for the finite ones of `values`: it ends at multiples of 1, 2 or 5 times a power
/// of ten, begins at zero where nothing is negative (if logarithmic at the decade of the smallest
/// positive value, at most six decades below the top), and leaves out the highest `cut` share of
/// the values, so that a few glints do not darken all else.
///
/// Source   round steps after P. Heckbert, "Nice Numbers for Graph Labels", Graphics Gems, 1990.
ValueScale round_scale(std::span<const double> values, bool logarithmic = false,
                       double cut = 0.001);

/// Scale given by hand.
/// @throws InputError if an end is not finite, low >= high, or logarithmic and low <= 0
ValueScale scale_between(double low, double high, bool logarithmic = false);

/// Smallest 1, 2 or 5 times a power of ten that is at least `value`. `value` is positive.
double round_up_125(double value);

/// `value` for a reader: thousands apart by commas, at most `decimals` decimals, no zeros after
/// them: `12,500`, `0.25`. Scientific from 1e9 on or below 1e-4.
std::string number_text(double value, int decimals = 4);

/// `value` with about `digits` significant digits, in the form of `number_text`: `12,300`.
std::string rounded_text(double value, int digits = 3);

}  // namespace tenku
