#include "study/time_limit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/stopwatch.h"

namespace tenku {
namespace {

constexpr double kForPilots = 0.125;    // of the time
constexpr double kFirstPilots = 256.0;  // sensors and pixels
constexpr double kMorePilots = 4.0;     // times as many, while there is time
constexpr double kUsualGrowth = 2.0;    // of the time from one tolerance to the next
constexpr double kBeyond = 2.0;         // finer than what was tried, at most
constexpr double kUsed = 0.85;          // of the time: files are written, and pilots err
constexpr std::array kTolerances{kCoarsestTolerance_pct, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2,
                                 kFinestTolerance_pct};

double between(const ExpectedTime& a, const ExpectedTime& b, double seconds) {
  const double rise = std::log(b.seconds / a.seconds);
  if (!(rise > 0.0)) return b.tolerance_pct;
  const double way = std::log(seconds / a.seconds) / rise;
  return a.tolerance_pct * std::pow(b.tolerance_pct / a.tolerance_pct, way);
}

double seconds_at(const std::vector<ExpectedTime>& tried, double tolerance_pct) {
  for (std::size_t k = 1; k < tried.size(); ++k) {
    const bool is_last = k + 1 == tried.size();
    if (tolerance_pct < tried[k].tolerance_pct && !is_last) continue;
    const ExpectedTime &a = tried[k - 1], &b = tried[k];
    const double way =
        std::log(tolerance_pct / a.tolerance_pct) / std::log(b.tolerance_pct / a.tolerance_pct);
    return a.seconds * std::pow(std::max(1.0, b.seconds / a.seconds), way);
  }
  return tried.front().seconds;
}

/// Two digits, never finer than what was found.
double rounded(double tolerance_pct) {
  const double step = std::pow(10.0, std::floor(std::log10(tolerance_pct)) - 1.0);
  return step * std::ceil(tolerance_pct / step - 1e-9);
}

}  // namespace

TimedTolerance finest_within(const std::vector<ExpectedTime>& tried, double most_s) {
  expects(!tried.empty(), "a tolerance was tried");
  TimedTolerance chosen;
  chosen.tried = tried;
  chosen.tolerance_pct = tried.front().tolerance_pct;
  chosen.is_reachable = tried.front().seconds <= most_s;
  for (std::size_t k = 1; k < tried.size() && chosen.is_reachable; ++k) {
    const bool is_last = k + 1 == tried.size();
    if (tried[k].seconds <= most_s && !is_last) continue;
    const double finest = tried[k].tolerance_pct / (is_last ? kBeyond : 1.0);
    const double found = between(tried[k - 1], tried[k], most_s);
    chosen.tolerance_pct = rounded(
        std::clamp(found, std::max(finest, kFinestTolerance_pct), tried[k - 1].tolerance_pct));
    break;
  }
  chosen.expected_s = seconds_at(tried, chosen.tolerance_pct);
  return chosen;
}

TimedTolerance tolerance_within(const DivisibleWork& work, double left_s, Progress& progress) {
  const Stopwatch watch;
  Progress quiet;
  const auto seconds = [&](double share, double tolerance) {
    progress.stop_if_cancelled();
    const Stopwatch one;
    work.run(share, tolerance, quiet);
    progress.advance(1);
    return one.seconds();
  };
  const double for_pilots_s = kForPilots * left_s;
  progress.begin("time limit", 0);
  double share =
      std::min(1.0, kFirstPilots / static_cast<double>(std::max<std::size_t>(1, work.count)));
  seconds(share, kCoarsestTolerance_pct);  // memory is touched
  double took = seconds(share, kCoarsestTolerance_pct), whole = took / share;
  while (share < 1.0 && watch.seconds() + kMorePilots * took < 0.5 * for_pilots_s) {
    const double more = std::min(1.0, kMorePilots * share);
    const double longer = seconds(more, kCoarsestTolerance_pct);
    const double slope = std::max(0.0, longer - took) / (more - share);
    whole = longer + slope * (1.0 - more);
    share = more, took = longer;
  }
  const double factor = whole / std::max(took, 1e-9);
  std::vector<ExpectedTime> tried{{kTolerances.front(), whole}};
  double growth = kUsualGrowth, last = took;
  for (std::size_t k = 1; k < kTolerances.size(); ++k) {
    if (tried.back().seconds > left_s || watch.seconds() + growth * last > for_pilots_s) break;
    const double next = std::max(last, seconds(share, kTolerances[k]));
    tried.push_back({kTolerances[k], factor * next});
    growth = std::max(1.2, next / last), last = next;
  }
  const double most_s = kUsed * (left_s - watch.seconds());
  TimedTolerance chosen = finest_within(tried, most_s);
  const std::string spent =
      fmt::format("pilots of {:.2g} % of the work, {:.1f} s", 100.0 * share, watch.seconds());
  if (!chosen.is_reachable) {
    chosen.why = fmt::format(
        "the time limit is too short: even to {:g} % the work is expected to take {:.3g} s, {:.3g} "
        "s "
        "are left ({}); it is done to {:g} %",
        chosen.tolerance_pct, chosen.expected_s, left_s, spent, chosen.tolerance_pct);
  } else {
    chosen.why = fmt::format("tolerance {:g} %: expected to take {:.3g} s of {:.3g} s left ({})",
                             chosen.tolerance_pct, chosen.expected_s, left_s, spent);
    for (const ExpectedTime& one : tried) {
      chosen.why += fmt::format("; {:g} %: {:.3g} s", one.tolerance_pct, one.seconds);
    }
  }
  progress.end(chosen.why);
  return chosen;
}

double seconds_named(const std::string& text, const std::string& what) {
  std::size_t read = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &read);
  } catch (const std::exception&) {
    read = 0;
  }
  const std::string unit = text.substr(read);
  if (unit == "m" || unit == "min") value *= 60.0;
  const bool is_known = unit.empty() || unit == "s" || unit == "m" || unit == "min";
  if (read == 0 || !is_known || !(value >= 1.0) || !(value <= 86400.0)) {
    throw InputError(what + " is 1s to 86400s, such as 120s or 2m, not '" + text + "'");
  }
  return value;
}

}  // namespace tenku
