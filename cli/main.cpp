#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "cli/command.h"
#include "cli/option_list.h"
#include "cli/terminal_progress.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/suggest.h"
#include "core/version.h"

namespace tenku {
namespace {

struct CommandEntry {
  const char* name;
  const char* description;
  const char* example;
  CommandBody (*make)(OptionList&);
};

std::vector<CommandEntry> commands() {
  return {
#include "cli/commands.inc"
  };
}

void add_common_options(OptionList& app, CommonOptions& options) {
  app.add_option("--threads", options.threads, "threads to use (default: all)");
  app.add_option("--seed", options.seed, "seed of the random numbers (default 1)");
  app.add_flag("--quiet", options.quiet, "print nothing but errors");
  app.add_flag("--verbose", options.verbose, "print more");
  app.add_flag("--json", options.json, "print a machine-readable summary on standard output");
}

int run_command(const CommandBody& body, const CommonOptions& options) {
  TerminalProgress progress(options.quiet);
  const ThreadLimit limit(options.threads);
  try {
    return body({options, progress});
  } catch (const InputError& error) {
    std::fprintf(stderr, "tenku: %s\n", error.what());
    return kInputWrong;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "tenku: out of memory\n");
    return kOtherFailure;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tenku: %s\n", error.what());
    return kOtherFailure;
  }
}

/// The first word, if it is meant as a command and is none.
std::optional<std::string> unknown_command(int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return std::nullopt;
  std::vector<std::string_view> names;
  for (const CommandEntry& entry : commands()) {
    if (argv[1] == std::string_view(entry.name)) return std::nullopt;
    names.emplace_back(entry.name);
  }
  return "there is no command '" + std::string(argv[1]) + "'" + suggestion(argv[1], names);
}

int main_with(int argc, char** argv) {
  CLI::App app{"Daylight and townscape analysis: sun, sky, illuminance, views."};
  app.name("tenku");
  app.set_version_flag("--version", std::string(software_name()));
  app.require_subcommand(1);
  if (const auto refusal = unknown_command(argc, argv)) {
    std::fprintf(stderr, "tenku: %s; tenku --help lists them\n", refusal->c_str());
    return kInputWrong;
  }
  CommonOptions options;
  std::map<const CLI::App*, CommandBody> bodies;
  for (const CommandEntry& entry : commands()) {
    CLI::App* command = app.add_subcommand(entry.name, entry.description);
    command->footer(std::string("Example:\n  ") + entry.example);
    OptionList list(*command);
    add_common_options(list, options);
    bodies[command] = entry.make(list);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kInputWrong;
  }
  return run_command(bodies.at(app.get_subcommands().front()), options);
}

}  // namespace
}  // namespace tenku

int main(int argc, char** argv) { return tenku::main_with(argc, argv); }
