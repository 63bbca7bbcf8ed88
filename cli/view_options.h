/// Options that say where the camera stands. Private to this module.
#pragma once

#include <string>

#include "study/lit_scene.h"
#include "view/camera.h"

namespace CLI {
class App;
}

namespace tenku {

/// `--eye`, `--target`, `--fov`, `--size`.
struct ViewOptions {
  std::string eye, target, size = "512x512";
  double fov_deg = 60.0;
};

void add_view_options(CLI::App& app, ViewOptions& options);

/// Finds before the scene is read what is wrong with the view.
/// @throws InputError
void check_view_options(const ViewOptions& options);

/// The view in the local frame; an overview where no eye is given.
/// @throws InputError
PerspectiveView resolve_view(const ViewOptions& options, const LitScene& lit);

}  // namespace tenku
