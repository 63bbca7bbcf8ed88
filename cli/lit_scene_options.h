/// The options of everything that lights a scene.
#pragma once

#include <optional>
#include <string>

#include "cli/command.h"
#include "cli/scene_options.h"
#include "cli/sky_options.h"
#include "core/progress.h"
#include "study/lit_scene.h"

namespace tenku {

/// Scene, site, sky, and how well to calculate.
struct LitSceneOptions {
  SceneOptions scene;
  SiteOptions site;
  SkyOptions sky;
  double tolerance_pct = 2.0;
  int bounces = 5;
  std::string engine = "auto", out;
};

void add_lit_scene_options(CLI::App& app, LitSceneOptions& options);

/// @throws InputError, ResourceError as the readers, the sky and the engine do
LitScene load_lit_scene(const LitSceneOptions& options, Progress& progress);

/// One line on each kind of finding, to standard error.
void say_findings(const CommonOptions& options, const std::vector<Finding>& findings);

}  // namespace tenku
