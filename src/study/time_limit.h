/// The tolerance that a time allows.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/progress.h"

namespace tenku {

/// What all of the work is expected to take at a tolerance.
struct ExpectedTime {
  double tolerance_pct, seconds;
};

struct TimedTolerance {
  double tolerance_pct = 0.0;  ///< to be taken
  double expected_s = 0.0;     ///< all of the work
  bool is_reachable = true;    ///< whether that fits into the time
  std::vector<ExpectedTime> tried;

  /// In a sentence: what was chosen, and why.
  std::string why;
};

/// Coarsest and finest that are tried, percent.
inline constexpr double kCoarsestTolerance_pct = 20.0, kFinestTolerance_pct = 0.1;

/// Seconds that all of the work is expected to take at a tolerance, from pilots: the plan's model.
using TimeModel = std::function<double(double tolerance_pct)>;

/// The finest tolerance at which the work is expected to end within a time.
///
/// The model is asked at the coarsest tolerance, then where the time seems to lead, as long as
/// asking takes no more than a quarter of the time, up to five times.
///
/// @param left_s  for asking and for the work
/// @throws what the model throws
TimedTolerance tolerance_within(const TimeModel& expected_s, double left_s, Progress& progress);

/// The finest tolerance whose expected time is at most `most_s`, of times tried from coarse to
/// fine.
/// @return below the coarsest: the coarsest, not reachable
TimedTolerance finest_within(const std::vector<ExpectedTime>& tried, double most_s,
                             double beyond = 2.0);

/// `60`, `60s`, `2m`, `2min`.
/// @param what  in the message: `a time limit`
/// @throws InputError  for any other form, and what is not within 1 s to a day
double seconds_named(const std::string& text, const std::string& what);

}  // namespace tenku
