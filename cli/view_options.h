/// Options that say where the camera stands. Private to this module.
#pragma once

#include <string>

#include "cli/lit_scene_options.h"
#include "view/view_render.h"

namespace tenku {

class OptionList;

/// `--eye`, `--target`, `--fov`, `--size`, `--mirrors`, `--depth`.
struct ViewOptions {
  std::string eye, target, size = "512x512", mirrors = "auto";
  double fov_deg = 60.0;
  int depth = MirrorOptions().depth;
};

void add_view_options(OptionList& app, ViewOptions& options);

/// Those that say what is seen alone.
/// @param size  of the picture, where none is given
void add_camera_options(OptionList& app, ViewOptions& options, const std::string& size);

/// Finds before the scene is read what is wrong with the view.
/// @throws InputError
void check_view_options(const ViewOptions& options);

/// The view in the local frame, an overview where no eye is given, and how it is lit.
/// @throws InputError
ViewRequest view_request(const ViewOptions& options, const LitSceneOptions& how,
                         const LitScene& lit, const CommonOptions& common);

}  // namespace tenku
