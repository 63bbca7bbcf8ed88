#include "study/speed_accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/error.h"
#include "core/memory_use.h"
#include "core/stopwatch.h"
#include "view/picture_difference.h"

namespace tenku {
namespace {

constexpr double kForReferences = 0.33;  // of the time
constexpr double kFinerCosts = 3.0;      // times as long, at half the tolerance, at most
constexpr double kUsualGrowth = 2.0;     // of the time from one setting to the next
constexpr double kKeptBack = 0.03;       // of the time, for writing
constexpr int kMostRepeats = 5;

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at =
      static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(values.size())) - 1.0);
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

double root_mean_square(const std::vector<double>& values) {
  const double sum = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

constexpr double kWhite = 255.0;

Image8 picture_of(const std::vector<double>& codes, int width) {
  Image8 picture(width, static_cast<int>(codes.size() / 3) / width);
  const auto code = [&](std::size_t k) { return static_cast<std::uint8_t>(std::lround(codes[k])); };
  for (std::size_t p = 0; p < picture.pixels.size(); ++p) {
    picture.pixels[p] = {code(3 * p), code(3 * p + 1), code(3 * p + 2)};
  }
  return picture;
}

/// Stops what goes on beyond the time.
class Deadline : public Progress {
 public:
  Deadline(const Progress& above, double limit_s) : above_(above), limit_s_(limit_s) {}
  bool is_cancelled() const override { return above_.is_cancelled() || is_over(); }
  bool is_over() const { return watch_.seconds() > limit_s_; }

 private:
  const Progress& above_;
  double limit_s_;
  Stopwatch watch_;
};

/// A setting with all of its runs.
struct Measured {
  std::vector<double> seconds;
  ChartPoint point;

  void take_times() {
    std::vector<double> sorted = seconds;
    std::sort(sorted.begin(), sorted.end());
    point.time_s = sorted[sorted.size() / 2];
    point.time_spread_s = sorted.back() - sorted.front();
    point.repeats = static_cast<int>(sorted.size());
  }
};

class ChartRun {
 public:
  ChartRun(const std::vector<ChartSetting>& settings, const std::vector<ChartReference>& references,
           double budget_s, double floor_lux, std::uint64_t seed, Progress& progress)
      : settings_(settings),
        references_(references),
        budget_s_(budget_s * (1.0 - kKeptBack)),
        floor_lux_(floor_lux),
        seed_(seed),
        progress_(progress) {}

  ChartResult finish() {
    const double share = kForReferences * budget_s_ / static_cast<double>(references_.size());
    for (std::size_t r = 0; r < references_.size(); ++r) converge(references_[r], share);
    progress_.begin("settings", settings_.size());
    const std::vector<std::size_t> order = in_turns();
    for (const std::size_t s : order) measure_first(s);
    repeat();
    progress_.end(std::to_string(measured_.size()) + " points");
    for (auto& [s, one] : measured_) {
      one.take_times();
      result_.points.push_back(std::move(one.point));
    }
    result_.seconds = watch_.seconds();
    rank_points(result_);
    return std::move(result_);
  }

 private:
  double left_s() const { return budget_s_ - watch_.seconds(); }

  /// As fine as its share of the time allows, and once more with another seed.
  void converge(const ChartReference& reference, double share_s) {
    progress_.begin("reference: " + reference.name, reference.tolerances_pct.size());
    Progress quiet;
    ReferenceResult found;
    found.name = reference.name;
    SensorValues first;
    double spent = 0.0;
    for (const double tolerance : reference.tolerances_pct) {
      progress_.stop_if_cancelled();
      const Stopwatch watch;
      first = reference.run(tolerance, seed_ + 1, quiet);
      const double took = watch.seconds();
      spent += took;
      found.tolerance_pct = tolerance;
      progress_.advance(1);
      // The next finer one is run twice.
      if (spent + took + 2.0 * kFinerCosts * took > share_s) break;
    }
    const Stopwatch watch;
    const SensorValues second = reference.run(found.tolerance_pct, seed_ + 2, quiet);
    found.seconds = spent + watch.seconds();
    found.is_picture = first.is_picture();
    found.difference = error_numbers(first, second.lux, floor_lux_);
    found.floor = 0.5 * found.difference.rms;
    for (std::size_t k = 0; k < first.lux.size(); ++k) {
      found.truth.push_back(0.5 * (first.lux[k] + second.lux[k]));
    }
    progress_.end("tolerance " + std::to_string(found.tolerance_pct) + " %");
    result_.references.push_back(std::move(found));
  }

  /// First settings of all methods, then second ones, and so on.
  std::vector<std::size_t> in_turns() const {
    std::map<std::string, std::size_t> rank_in_method;
    std::vector<std::pair<std::size_t, std::size_t>> ranked;
    for (std::size_t s = 0; s < settings_.size(); ++s) {
      ranked.emplace_back(rank_in_method[line_of(settings_[s])]++, s);
    }
    std::sort(ranked.begin(), ranked.end());
    std::vector<std::size_t> order;
    for (const auto& [rank, s] : ranked) order.push_back(s);
    return order;
  }

  static std::string name_of(const ChartSetting& setting) {
    return setting.stage + ", " + setting.method + ", " + setting.setting;
  }
  static std::string line_of(const ChartSetting& setting) {
    return setting.stage + "/" + setting.method;
  }

  /// Seconds that a setting is expected to take, by those before it in its method.
  double expected_s(std::size_t s) const {
    const auto& before = line_seconds_.find(line_of(settings_[s]));
    if (before == line_seconds_.end() || before->second.empty()) return 0.0;
    const std::vector<double>& seconds = before->second;
    const double last = seconds.back();
    const double growth =
        seconds.size() > 1 ? std::max(1.0, last / seconds[seconds.size() - 2]) : kUsualGrowth;
    return growth * last;
  }

  void measure_first(std::size_t s) {
    progress_.stop_if_cancelled();
    progress_.advance(1);
    const ChartSetting& setting = settings_[s];
    if (left_s() <= 0.0 || expected_s(s) > left_s()) {
      result_.left_out.push_back(name_of(setting));
      return;
    }
    reset_peak_memory();
    Deadline deadline(progress_, left_s());
    const Stopwatch watch;
    SensorValues values;
    try {
      values = setting.run(deadline);
    } catch (const Cancelled&) {
      if (progress_.is_cancelled()) throw;
      result_.left_out.push_back(name_of(setting));
      return;
    }
    Measured one;
    one.seconds.push_back(watch.seconds());
    line_seconds_[line_of(setting)].push_back(one.seconds.back());
    ChartPoint& point = one.point;
    point.stage = setting.stage, point.method = setting.method, point.setting = setting.setting;
    point.study = setting.study, point.reference = setting.reference;
    point.memory_mb = peak_memory_mb();
    take_errors(values, point);
    measured_.emplace(s, std::move(one));
  }

  void take_errors(const SensorValues& values, ChartPoint& point) const {
    const ReferenceResult& reference = result_.references[point.reference];
    point.error = error_numbers(values, reference.truth, floor_lux_);
    std::vector<double> intervals;
    for (std::size_t k = 0; k < values.lux.size(); ++k) {
      const double whole = values.is_picture() ? kWhite : std::max(reference.truth[k], floor_lux_);
      if (!values.error_lux.empty()) intervals.push_back(100.0 * values.error_lux[k] / whole);
      point.sensor_error_pct.push_back(100.0 * (values.lux[k] - reference.truth[k]) / whole);
    }
    point.predicted_error =
        intervals.empty() ? std::numeric_limits<double>::quiet_NaN() : root_mean_square(intervals);
    point.is_under_floor = point.error.rms <= reference.floor;
  }

  /// Settings again, the quickest first, while there is time.
  void repeat() {
    std::vector<std::pair<double, std::size_t>> quickest;
    for (const auto& [s, one] : measured_) quickest.emplace_back(one.seconds.front(), s);
    std::sort(quickest.begin(), quickest.end());
    for (int turn = 1; turn < kMostRepeats; ++turn) {
      for (const auto& [seconds, s] : quickest) {
        progress_.stop_if_cancelled();
        if (1.3 * seconds > left_s()) break;
        const Stopwatch watch;
        Progress quiet;
        settings_[s].run(quiet);
        measured_.at(s).seconds.push_back(watch.seconds());
      }
    }
  }

  const std::vector<ChartSetting>& settings_;
  const std::vector<ChartReference>& references_;
  double budget_s_, floor_lux_;
  std::uint64_t seed_;
  Progress& progress_;
  Stopwatch watch_;
  std::map<std::string, std::vector<double>> line_seconds_;
  std::map<std::size_t, Measured> measured_;
  ChartResult result_;
};

/// How far below the line between two others a point lies, in decades.
double below_line(const ChartPoint& a, const ChartPoint& b, const ChartPoint& p) {
  const auto x = [](const ChartPoint& q) { return std::log10(std::max(q.time_s, 1e-9)); };
  const auto y = [](const ChartPoint& q) { return std::log10(std::max(q.error.rms, 1e-9)); };
  const double width = x(b) - x(a);
  if (!(width > 0.0)) return 0.0;
  return y(a) + (x(p) - x(a)) / width * (y(b) - y(a)) - y(p);
}

void rank_stage(std::vector<ChartPoint*>& points) {
  std::sort(points.begin(), points.end(), [](const ChartPoint* a, const ChartPoint* b) {
    return a->time_s != b->time_s ? a->time_s < b->time_s : a->error.rms < b->error.rms;
  });
  std::vector<ChartPoint*> front;
  for (ChartPoint* p : points) {
    if (p->is_under_floor) continue;
    if (front.empty() || p->error.rms < front.back()->error.rms) front.push_back(p);
  }
  ChartPoint* knee = nullptr;
  double lowest = 0.0;
  for (std::size_t k = 0; k < front.size(); ++k) {
    front[k]->is_on_front = true;
    const double below = below_line(*front.front(), *front.back(), *front[k]);
    if (below > lowest) lowest = below, knee = front[k];
    if (k == 0) continue;
    const double gap = front[k]->time_s - front[k - 1]->time_s;
    if (gap < 0.5 * (front[k]->time_spread_s + front[k - 1]->time_spread_s)) {
      front[k]->is_order_unsure = front[k - 1]->is_order_unsure = true;
    }
  }
  if (knee != nullptr) knee->is_knee = true;
}

}  // namespace

std::string tolerance_text(double tolerance_pct) { return fmt::format("{:g} %", tolerance_pct); }

SensorValues values_of(const SensorIlluminance& found) {
  SensorValues values;
  values.error_lux = found.error_lux;
  for (std::size_t s = 0; s < found.size(); ++s) values.lux.push_back(found.total_lux(s));
  return values;
}

ErrorNumbers error_numbers(const std::vector<double>& lux, const std::vector<double>& truth,
                           double floor_lux) {
  ErrorNumbers numbers;
  std::vector<double> relative, absolute;
  for (std::size_t k = 0; k < lux.size(); ++k) {
    absolute.push_back(std::abs(lux[k] - truth[k]));
    relative.push_back(100.0 * absolute.back() / std::max({truth[k], floor_lux, 1e-300}));
    if (relative.back() > relative[numbers.worst_sensor]) numbers.worst_sensor = k;
  }
  if (relative.empty()) return numbers;
  numbers.rms = root_mean_square(relative), numbers.rms_lux = root_mean_square(absolute);
  numbers.p95 = quantile(relative, 0.95), numbers.p95_lux = quantile(absolute, 0.95);
  numbers.worst = relative[numbers.worst_sensor];
  numbers.worst_lux = *std::max_element(absolute.begin(), absolute.end());
  return numbers;
}

ErrorNumbers error_numbers(const SensorValues& values, const std::vector<double>& truth,
                           double floor_lux) {
  if (!values.is_picture()) return error_numbers(values.lux, truth, floor_lux);
  ErrorNumbers numbers = error_numbers(values.lux, truth, kWhite);
  const Image8 a = picture_of(values.lux, values.width), b = picture_of(truth, values.width);
  numbers.mean_255 = mean_difference(a, b);
  numbers.similarity = structural_similarity(a, b);
  return numbers;
}

ChartResult measure_chart(const std::vector<ChartSetting>& settings,
                          const std::vector<ChartReference>& references, double budget_s,
                          double floor_lux, std::uint64_t seed, Progress& progress) {
  return ChartRun(settings, references, budget_s, floor_lux, seed, progress).finish();
}

void rank_points(ChartResult& result) {
  std::map<std::string, std::vector<ChartPoint*>> stages;
  for (ChartPoint& point : result.points) {
    point.is_on_front = point.is_knee = point.is_order_unsure = false;
    stages[point.stage].push_back(&point);
  }
  for (auto& [name, points] : stages) rank_stage(points);
}

const ChartPoint* cheapest_within(const ChartResult& result, std::size_t reference,
                                  double error_pct) {
  const ChartPoint* best = nullptr;
  for (const ChartPoint& point : result.points) {
    if (point.reference != reference || point.error.p95 > error_pct) continue;
    if (best == nullptr || point.time_s < best->time_s) best = &point;
  }
  return best;
}

}  // namespace tenku
