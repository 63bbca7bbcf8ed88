/// What the subcommands share. Each lives in `command_<name>.cpp` and is thin: it reads options,
/// calls the library, writes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace tenku {

class OptionList;
class Progress;

/// Exit codes of the contract.
enum ExitCode : int { kDone = 0, kOtherFailure = 1, kInputWrong = 2, kToleranceNotReached = 3 };

/// Options that every subcommand has.
struct CommonOptions {
  unsigned threads = 0;  ///< 0: all
  std::uint64_t seed = 1;
  bool quiet = false, verbose = false, json = false;
};

/// What a subcommand is given when it runs.
struct CommandContext {
  const CommonOptions& options;
  Progress& progress;  ///< a bar on a terminal, one log line a stage otherwise; watches Ctrl-C
};

/// A subcommand registers its options on `app` (its own subcommand, already made) and returns what
/// is called when it is chosen. The returned function gives the exit code; it may throw InputError
/// (exit 2), ResourceError or anything else (exit 1).
using CommandBody = std::function<int(const CommandContext&)>;

CommandBody make_sun_command(OptionList& app);
CommandBody make_sky_command(OptionList& app);
CommandBody make_inspect_command(OptionList& app);
CommandBody make_illuminance_command(OptionList& app);
CommandBody make_plan_command(OptionList& app);
CommandBody make_render_command(OptionList& app);
CommandBody make_radiosity_command(OptionList& app);
CommandBody make_form_factors_command(OptionList& app);
CommandBody make_reflections_command(OptionList& app);
CommandBody make_chart_command(OptionList& app);
CommandBody make_compare_command(OptionList& app);
CommandBody make_flythrough_command(OptionList& app);
CommandBody make_play_command(OptionList& app);
CommandBody make_run_command(OptionList& app);

/// Writes one line to standard error unless `--quiet`.
void say(const CommonOptions& options, const std::string& line);

}  // namespace tenku
