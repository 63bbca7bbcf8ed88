/// How a scene is read: the options that all subcommands with a scene share.
#pragma once

#include <string>
#include <vector>

#include "scene/read_scene.h"

namespace tenku {

class OptionList;

struct SceneOptions {
  std::string scene;        ///< path of the scene file
  std::string materials;    ///< path, or empty
  std::string up = "auto";  ///< `auto`, `y` or `z`
  std::string crs, ground = "auto", building_lod;
  double rotate_deg = 0.0, scale = 1.0;
  std::vector<std::string> terrain;  ///< paths
  std::string on_terrain = "auto";
  std::string around;  ///< `x,y,half`, or empty
  bool strict = false;
};

/// Registers the positional SCENE and the options on a subcommand.
void add_scene_options(OptionList& app, SceneOptions& options);

/// @throws InputError if a text is none of its choices
ReadOptions read_options(const SceneOptions& options);

}  // namespace tenku
