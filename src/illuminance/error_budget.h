/// How wrong a value may be, and how wrong it is.
#pragma once

#include <algorithm>
#include <cmath>

namespace tenku {

/// The error asked for.
///
/// A value is good enough when four standard errors fit into the tolerance: the reported 95 %
/// interval (1.96 standard errors) is then at most half of it, and one value in 16,000 lies
/// outside the tolerance itself.
class ErrorBudget {
 public:
  /// @param tolerance_pct      percent of each value
  /// @param floor_lux          lower values are held to it instead
  ErrorBudget(double tolerance_pct, double floor_lux)
      : relative_(tolerance_pct / 100.0), floor_lux_(floor_lux) {}

  double allowed_lux(double value_lux) const { return relative_ * std::max(value_lux, floor_lux_); }

  /// Variance below which a value needs no more work.
  double allowed_variance(double value_lux) const {
    const double sd = allowed_lux(value_lux) / kErrorsInTolerance;
    return sd * sd;
  }

  static constexpr double kErrorsInTolerance = 4.0;
  static constexpr double kErrorsIn95 = 1.959963984540054;  ///< normal quantile of 0.975

 private:
  double relative_, floor_lux_;
};

/// Half-width of the 95 % interval from the variance of what was sampled (all parts independent)
/// and the bound on what was left out.
inline double interval_lux(double variance, double left_out_lux) {
  return ErrorBudget::kErrorsIn95 * std::sqrt(variance) + left_out_lux;
}

}  // namespace tenku
