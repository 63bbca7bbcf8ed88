/// How a scene is read: the options that all subcommands with a scene share.
#pragma once

#include <string>

#include "scene/read_scene.h"

namespace CLI {
class App;
}

namespace tenku {

struct SceneOptions {
  std::string scene;        ///< path of the scene file
  std::string materials;    ///< path, or empty
  std::string up = "auto";  ///< `auto`, `y` or `z`
  std::string crs, ground = "auto", building_lod;
  double rotate_deg = 0.0, scale = 1.0;
  bool strict = false;
};

/// Registers the positional SCENE and the options on a subcommand.
void add_scene_options(CLI::App& app, SceneOptions& options);

/// @throws InputError if a text is none of its choices
ReadOptions read_options(const SceneOptions& options);

}  // namespace tenku
