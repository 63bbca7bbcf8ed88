/// The tolerance that a time allows.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/progress.h"

namespace tenku {

/// Work that can be done in part, and to any tolerance.
struct DivisibleWork {
  std::size_t count = 0;  ///< sensors and pixels
  /// Does a share of it (0 to 1), spread over all of it, for its time alone.
  std::function<void(double share, double tolerance_pct, Progress& progress)> run;
};

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

/// The finest tolerance at which the work is expected to end within a time.
///
/// Pilots, as those of `tenku plan`: shares of the work are done at the coarsest tolerance, each
/// four times the one before; what the last two differ by is the time of the rest. Then the largest
/// of them at finer tolerances, as `tenku chart` goes through its settings: each is expected to
/// take as much longer as the one before it did. Pilots get an eighth of the time. Between
/// tolerances, and up to a factor 2 beyond the finest that was tried, times follow a power of the
/// tolerance.
///
/// @param left_s  for pilots and work
/// @throws what the work throws
TimedTolerance tolerance_within(const DivisibleWork& work, double left_s, Progress& progress);

/// The finest tolerance whose expected time is at most `most_s`, of times tried from coarse to
/// fine.
/// @return below the coarsest: the coarsest, not reachable
TimedTolerance finest_within(const std::vector<ExpectedTime>& tried, double most_s);

/// `60`, `60s`, `2m`, `2min`.
/// @param what  in the message: `a time limit`
/// @throws InputError  for any other form, and what is not within 1 s to a day
double seconds_named(const std::string& text, const std::string& what);

}  // namespace tenku
