/// A chart of speed against accuracy as files: `chart.csv`, `chart.html`, `chart.png`,
/// `recommended.toml`.
#pragma once

#include <filesystem>
#include <string>

#include "study/lit_scene.h"
#include "study/speed_accuracy.h"

namespace tenku {

/// What the files tell of the run.
struct ChartStory {
  std::string scene;    ///< file as given
  std::string sensors;  ///< in words
  double budget_s = 0.0;
  unsigned threads = 0;
  std::uint64_t seed = 0;
};

/// Columns of `chart.csv`: those of the contract, then more.
inline constexpr std::string_view kChartHeader =
    "stage,method,setting,time_s,time_spread_s,memory_mb,rms_error,p95_error,max_error,"
    "predicted_error,on_front,is_knee,under_floor,order_unsure,repeats,rms_lux,p95_lux,max_lux,"
    "worst_x,worst_y,worst_z,reference_floor,mean_255,similarity";

/// The errors for which a setting is told, percent.
inline constexpr double kChartErrors[] = {10.0, 5.0, 2.0, 1.0, 0.5};

/// @param sensors  in the local frame
/// @throws InputError, ResourceError as writing does
void write_chart(const std::filesystem::path& folder, const ChartResult& result,
                 const LitScene& lit, const Sensors& sensors, const ChartStory& story);

}  // namespace tenku
