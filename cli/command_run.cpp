#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/lit_scene_options.h"
#include "cli/option_list.h"
#include "study/run_study.h"
#include "study/study_reader.h"
#include "study/time_limit.h"

namespace tenku {
namespace {

struct RunOptions {
  std::string study, out;
  StudyOverrides overrides;
  std::string scene, time_limit;
};

bool has(const std::filesystem::path& path, const char* ending) {
  return path.extension() == ending;
}

/// Three lines that say where to look.
void say_where_to_look(const CommonOptions& options, const StudyOutcome& outcome) {
  std::string pictures, fields, report;
  for (const auto& file : outcome.files) {
    std::string& list = file.filename() == "report.html"         ? report
                        : has(file, ".vtp") || has(file, ".csv") ? fields
                        : has(file, ".json")                     ? report
                                                                 : pictures;
    list += (list.empty() ? "" : ", ") + file.string();
  }
  if (!report.empty()) say(options, "report    " + report);
  if (!pictures.empty()) say(options, "pictures  " + pictures);
  if (!fields.empty()) say(options, "fields    " + fields);
}

int run(RunOptions options, const CommandContext& context) {
  options.overrides.scene = options.scene;
  std::optional<double> time_limit_s;
  if (!options.time_limit.empty()) time_limit_s = seconds_named(options.time_limit, "a time limit");
  Study study = read_study(options.study, options.overrides);
  const StudyOutcome outcome = run_study(study, options.out, context.progress, time_limit_s);
  say_findings(context.options, outcome.findings);
  say_where_to_look(context.options, outcome);
  if (context.options.json) {
    nlohmann::ordered_json summary{{"out_of_tolerance", outcome.out_of_tolerance}};
    if (time_limit_s) {
      summary["tolerance_percent"] = outcome.tolerance_pct;
      summary["is_in_time"] = outcome.is_in_time;
    }
    for (const auto& file : outcome.files) summary["files"].push_back(file.string());
    fmt::print("{}\n", summary.dump(2));
  }
  return outcome.out_of_tolerance > 0 || !outcome.is_in_time ? kToleranceNotReached : kDone;
}

}  // namespace

CommandBody make_run_command(OptionList& app) {
  const auto options = std::make_shared<RunOptions>();  // outlives this call
  app.add_option("study", options->study, "study file (TOML)").required();
  app.add_option("--out", options->out, "folder for the results; made if need be").required();
  app.add_option("--scene", options->scene, "scene file in place of the study's");
  app.add_option("--time", options->overrides.time, "time in place of the study's");
  app.add_option("--time-limit", options->time_limit,
                 "60s or 2m: the finest tolerance that is expected to end by then, in place of the "
                 "study's");
  return [options](const CommandContext& context) { return run(*options, context); };
}

}  // namespace tenku
