/// Speed against accuracy: many ways to the same numbers, each timed and held against a reference.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "illuminance/sensor.h"

namespace tenku {

/// What a calculation says of all sensors. Shape  both [sensor]. Units  lux.
///
/// Of a picture the codes of its pixels, channel by channel, 0 to 255: errors are then in percent
/// of white.
struct SensorValues {
  std::vector<double> lux;
  std::vector<double> error_lux;  ///< half-widths of its 95 % intervals; empty: not told
  int width = 0;                  ///< of a picture, pixels; 0: sensors

  bool is_picture() const { return width > 0; }
};

SensorValues values_of(const SensorIlluminance& found);

/// A tolerance as the setting of a method, `5 %`.
std::string tolerance_text(double tolerance_pct);

/// One way to calculate, at one setting.
struct ChartSetting {
  std::string stage;    ///< of `chart_stages`
  std::string method;   ///< settings of one method lie on one line of the chart
  std::string setting;  ///< in words, `64 elements`
  std::string study;  ///< keys of a study's `[calculation]` that ask for it; empty: there are none
  std::size_t reference = 0;  ///< which of the references it is held against
  std::function<SensorValues(Progress&)> run;
};

/// Something converged to hold settings against.
struct ChartReference {
  std::string name;
  std::vector<double> tolerances_pct;  ///< to try, falling, as long as there is time
  std::function<SensorValues(double tolerance_pct, std::uint64_t seed, Progress&)> run;
};

/// Errors of values against others, each relative to the larger of that and a floor.
struct ErrorNumbers {
  double rms = 0.0, p95 = 0.0, worst = 0.0;              ///< percent
  double rms_lux = 0.0, p95_lux = 0.0, worst_lux = 0.0;  ///< absolute
  std::size_t worst_sensor = 0;                          ///< by the relative error
  /// Of a picture: mean difference of its codes, in 1/255, and structural similarity.
  double mean_255 = 0.0, similarity = 1.0;
};

/// The same against what is true: of pictures relative to white.
ErrorNumbers error_numbers(const SensorValues& values, const std::vector<double>& truth,
                           double floor_lux);

/// @param floor_lux  lower values are held to it
ErrorNumbers error_numbers(const std::vector<double>& lux, const std::vector<double>& truth,
                           double floor_lux);

/// A setting as measured.
struct ChartPoint {
  std::string stage, method, setting, study;
  std::size_t reference = 0;
  double time_s = 0.0, time_spread_s = 0.0;  ///< median of the repeats; largest less smallest
  int repeats = 0;
  double memory_mb = 0.0;  ///< most that the process held while it ran, the scene included
  ErrorNumbers error;
  double predicted_error = 0.0;  ///< root mean square of its own 95 % intervals, percent; NaN: none
  bool is_on_front = false;      ///< nothing faster is better
  bool is_knee = false;          ///< of the front: beyond it accuracy costs more than it is worth
  bool is_under_floor = false;   ///< as good as the reference: not ranked
  bool is_order_unsure = false;  ///< its times overlap those of its neighbour on the front
  std::vector<double> sensor_error_pct;  ///< [sensor], signed
};

struct ReferenceResult {
  std::string name;
  double tolerance_pct = 0.0;
  double seconds = 0.0;       ///< of both runs
  ErrorNumbers difference;    ///< between its two runs
  double floor = 0.0;         ///< its own error, percent: half of that difference's RMS
  std::vector<double> truth;  ///< [sensor], mean of both runs, lux
  bool is_picture = false;
};

struct ChartResult {
  std::vector<ChartPoint> points;
  std::vector<ReferenceResult> references;
  std::vector<std::string> left_out;  ///< settings that the time did not allow
  double seconds = 0.0;
};

/// Runs references and settings within a time.
///
/// The references get up to a third of the time, two runs each with seeds of their own. Settings
/// take turns over the methods, cheap ones first, each expected to take as much longer than the
/// one before it in its method as that did than its own (twice, where there is no other); what is
/// expected not to fit is left out and named. What time is left goes to repeats.
///
/// @param settings  of a method from cheap to costly
/// @param floor_lux lower values are held to it
/// @throws Cancelled, and what the settings throw
ChartResult measure_chart(const std::vector<ChartSetting>& settings,
                          const std::vector<ChartReference>& references, double budget_s,
                          double floor_lux, std::uint64_t seed, Progress& progress);

/// Marks, in each stage, the front, its knee, and what cannot be ranked.
///
/// The front: points that no other of the stage beats in both time and RMS error. The knee: the one
/// farthest below the line between its ends, both axes logarithmic (V. Satopaa et al., "Finding a
/// kneedle in a haystack", ICDCS Workshops 2011, for the idea).
void rank_points(ChartResult& result);

/// The cheapest point of all stages on one reference whose p95 error is within `error_pct`; none
/// if there is none. Points under the floor count if the floor does.
const ChartPoint* cheapest_within(const ChartResult& result, std::size_t reference,
                                  double error_pct);

}  // namespace tenku
