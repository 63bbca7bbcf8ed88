/// A study from its file to its results: the whole program on one page.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/finding.h"
#include "core/progress.h"
#include "study/study.h"

namespace tenku {

/// What a study left behind.
struct StudyOutcome {
  std::vector<std::filesystem::path> files;
  std::size_t out_of_tolerance = 0;  ///< sensors and pixels that reached the limit of effort first
  double tolerance_pct = 0.0;        ///< that all was done to
  bool is_in_time = true;  ///< false: even the coarsest tolerance is expected to take longer
  std::vector<Finding> findings;
};

/// Runs a study and writes its results into a folder, which is made if need be: views, fields,
/// tables, plan, sun path, `report.html` and `manifest.json`.
/// @param time_limit_s  from now, seconds: replaces the study's tolerance by the finest that is
///                      expected to end by then, or by the coarsest (`tolerance_within`)
/// @throws InputError, ResourceError, Cancelled
StudyOutcome run_study(const Study& study, const std::filesystem::path& folder, Progress& progress,
                       std::optional<double> time_limit_s = {});

}  // namespace tenku
