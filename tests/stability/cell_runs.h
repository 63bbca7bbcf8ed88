/// What the cells of the matrix share: a run of the program, and what it must come to.
#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "cli/lit_scene_files.h"
#include "stability/matrix.h"
#include "stability/matrix_scene.h"
#include "support/reference_table.h"
#include "support/run_program.h"

namespace tenku::stability {

using testing_support::ProgramRun;
using testing_support::ReferenceTable;
using testing_support::run_tenku;
using testing_support::write_text;
namespace fs = std::filesystem;

/// Every value within its interval of the truth, but for one in ten: intervals hold 95 %.
/// @param step_lux  what the sky's table or the float steps of the output leave
inline Outcome holds(const fs::path& table, const std::vector<Probe>& probes,
                     double step_lux = 0.5) {
  const ReferenceTable lit(table.string());
  EXPECT_EQ(lit.size(), probes.size());
  double worst = 0.0;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < std::min(lit.size(), probes.size()); ++i) {
    const double off = std::abs(lit.number(i, "total_lux") - probes[i].truth_lux);
    inside += off <= lit.number(i, "error_lux") + step_lux;  // NaN is not inside
    worst = std::max(worst, off);
  }
  Outcome outcome{"right", fmt::format("{} of {} within their intervals, {:.2g} lx off at worst",
                                       inside, probes.size(), worst)};
  EXPECT_GE(static_cast<double>(inside), 0.9 * static_cast<double>(probes.size())) << outcome.note;
  return outcome;
}

/// The finding says its code and the object or sensor.
inline Outcome told(const ProgramRun& run, const std::string& code, const std::string& place) {
  const std::size_t at = run.err.find(code);
  EXPECT_NE(at, std::string::npos) << code << "\n" << run.err;
  EXPECT_NE(run.err.find(place, std::min(at, run.err.size())), std::string::npos) << run.err;
  return {"told", "`" + code + "`"};
}

inline Outcome refused(const ProgramRun& run, const std::string& cause) {
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_NE(run.err.find(cause), std::string::npos) << run.err;
  return {"refused", "exit code 2"};
}

inline void expect_done(const ProgramRun& run) {
  EXPECT_TRUE(run.exit_code == 0 || run.exit_code == 3) << run.exit_code << run.err;
}

}  // namespace tenku::stability
