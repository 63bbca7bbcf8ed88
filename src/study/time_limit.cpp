#include "study/time_limit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/stopwatch.h"

namespace tenku {
namespace {

constexpr double kForAsking = 0.25;    // of the time
constexpr std::size_t kMostAsked = 5;  // times
constexpr double kUsed = 0.85;         // of the time: files are written, and pilots err
constexpr double kBeyond = 2.0;        // finer than what was asked, at most, for the choice
constexpr double kFarther = 100.0;     // finer than what was asked, at most, for the next question
constexpr double kNear = 1.15;         // of a tolerance that was asked: near enough
constexpr double kFinerCosts = 2.0;    // power of the tolerance by which time rises, beyond

/// Power of the tolerance by which time has risen last.
double last_power(const std::vector<ExpectedTime>& tried) {
  const ExpectedTime &a = tried[tried.size() - 2], &b = tried.back();
  const double power =
      std::log(b.seconds / a.seconds) / std::log(a.tolerance_pct / b.tolerance_pct);
  return std::clamp(power, 0.5, kFinerCosts);
}

/// Two digits, never finer than what was found.
double rounded(double tolerance_pct) {
  const double step = std::pow(10.0, std::floor(std::log10(tolerance_pct)) - 1.0);
  return step * std::ceil(tolerance_pct / step - 1e-9);
}

}  // namespace

TimedTolerance finest_within(const std::vector<ExpectedTime>& tried, double most_s, double beyond) {
  expects(!tried.empty(), "a tolerance was tried");
  TimedTolerance chosen;
  chosen.tried = tried;
  chosen.tolerance_pct = tried.front().tolerance_pct;
  chosen.expected_s = tried.front().seconds;
  chosen.is_reachable = chosen.expected_s <= most_s;
  if (!chosen.is_reachable) return chosen;
  std::vector<ExpectedTime> known = tried;
  const ExpectedTime finest = tried.back();
  const double end = std::max(kFinestTolerance_pct, finest.tolerance_pct / beyond);
  const double power = beyond > kBeyond && tried.size() > 1 ? last_power(tried) : kFinerCosts;
  known.push_back({end, finest.seconds * std::pow(finest.tolerance_pct / end, power)});
  std::size_t k = 1;
  while (k + 1 < known.size() && known[k].seconds <= most_s) ++k;
  const ExpectedTime &a = known[k - 1], &b = known[k];
  if (b.seconds <= most_s) {
    chosen.tolerance_pct = b.tolerance_pct;
    chosen.expected_s = b.seconds;
    return chosen;
  }
  const double way = std::log(most_s / a.seconds) / std::log(b.seconds / a.seconds);
  const double ratio = b.tolerance_pct / a.tolerance_pct;
  chosen.tolerance_pct = std::min(a.tolerance_pct, rounded(a.tolerance_pct * std::pow(ratio, way)));
  const double back = std::log(chosen.tolerance_pct / a.tolerance_pct) / std::log(ratio);
  chosen.expected_s = a.seconds * std::pow(b.seconds / a.seconds, back);
  return chosen;
}

TimedTolerance tolerance_within(const TimeModel& expected_s, double left_s, Progress& progress) {
  const Stopwatch watch;
  progress.begin("time limit", 0);
  std::vector<ExpectedTime> tried;
  double asked_s = 0.0;  // the last question
  const auto ask = [&](double tolerance_pct) {
    progress.stop_if_cancelled();
    const Stopwatch one;
    tried.push_back({tolerance_pct, expected_s(tolerance_pct)});
    asked_s = one.seconds();
    std::sort(tried.begin(), tried.end(), [](const ExpectedTime& a, const ExpectedTime& b) {
      return a.tolerance_pct > b.tolerance_pct;
    });
    for (std::size_t k = 1; k < tried.size(); ++k) {  // clocks err: finer is not sooner
      tried[k].seconds = std::max(tried[k].seconds, tried[k - 1].seconds);
    }
  };
  const auto most_s = [&] { return kUsed * (left_s - watch.seconds()); };
  ask(kCoarsestTolerance_pct);
  while (tried.size() < kMostAsked && watch.seconds() + 1.5 * asked_s < kForAsking * left_s) {
    const TimedTolerance next = finest_within(tried, most_s(), kFarther);
    const bool is_known = std::any_of(tried.begin(), tried.end(), [&](const ExpectedTime& t) {
      return std::max(t.tolerance_pct / next.tolerance_pct, next.tolerance_pct / t.tolerance_pct) <
             kNear;
    });
    if (!next.is_reachable || is_known) break;
    ask(next.tolerance_pct);
  }
  TimedTolerance chosen = finest_within(tried, most_s());
  std::string times;
  for (const ExpectedTime& one : tried) {
    times += fmt::format("{}{:g} %: {:.3g} s", times.empty() ? "" : ", ", one.tolerance_pct,
                         one.seconds);
  }
  const std::string left = fmt::format("{:.3g} s are left, asking took {:.1f} s of {:.3g} s",
                                       left_s - watch.seconds(), watch.seconds(), left_s);
  if (chosen.is_reachable) {
    chosen.why = fmt::format("tolerance {:g} %: expected to take {:.3g} s; {} (expected at {})",
                             chosen.tolerance_pct, chosen.expected_s, left, times);
  } else {
    chosen.why = fmt::format(
        "the time limit is too short: even at {:g} % the work is expected to take {:.3g} s; {}; it "
        "is "
        "done at {:g} %",
        chosen.tolerance_pct, chosen.expected_s, left, chosen.tolerance_pct);
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
