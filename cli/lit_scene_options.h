/// The options of everything that lights a scene.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/partition_options.h"
#include "cli/scene_options.h"
#include "cli/sky_options.h"
#include "core/progress.h"
#include "illuminance/decision.h"
#include "illuminance/light_plan.h"
#include "study/lit_scene.h"

namespace tenku {

class OptionList;

/// Scene, site, sky, and how well to calculate.
struct LitSceneOptions {
  SceneOptions scene;
  SiteOptions site;
  SkyOptions sky;
  PartitionOptions partition;
  double tolerance_pct = 2.0;
  int bounces = 5;
  std::string engine = "auto", lod = "budget", gl = "auto", reflection = "auto", out;
  double mu = 1.0;
};

/// All but `--out`.
void add_lit_scene_options(OptionList& app, LitSceneOptions& options);
/// `--out`, which must be given.
void add_out_option(OptionList& app, LitSceneOptions& options);

/// @throws InputError, ResourceError as the readers, the sky and the engine do
LitScene load_lit_scene(const LitSceneOptions& options, Progress& progress);

/// @throws InputError for names that are not known
LightMethod light_method(const LitSceneOptions& options);

IlluminanceOptions illuminance_options(const LitSceneOptions& options, const CommonOptions& common);

/// What a calculation came to.
struct CalculationSummary {
  std::chrono::steady_clock::time_point start;
  std::uint64_t rays = 0;
  std::string counted;  ///< `sensors` or `pixels`
  std::size_t count = 0, out_of_tolerance = 0;
  double error_mean = 0.0;
  std::string decide{};  ///< what was to be decided; empty: nothing
  DecisionCounts decided{};
  std::vector<PlannedRegion> regions;
  std::vector<Finding> findings;  ///< of the calculation; the scene and the sky have their own
};

/// Tells the findings of scene, sky and calculation, and with `--json` the summary.
/// @return the exit code
int close_calculation(const CommonOptions& options, const LitScene& lit,
                      const CalculationSummary& summary);

/// One line on each kind of finding, to standard error.
void say_findings(const CommonOptions& options, const std::vector<Finding>& findings);

}  // namespace tenku
