/// The Cornell box of scenes/verification and its published camera.
#pragma once

#include <cmath>
#include <string>

#include "study/lit_scene.h"
#include "study/scene_reflection.h"
#include "view/view_render.h"

namespace tenku::testing_support {

/// @param folder  scenes/verification/cornell_box
inline LitScene cornell_box(const std::filesystem::path& folder) {
  ReadOptions options;
  options.materials = folder / "materials.toml";
  Progress quiet;
  return LitScene(
      folder / "cornell_box.obj", options, [](const auto&) { return Sky{}; }, {}, {}, quiet);
}

/// From (278, 273, -800) along z in the published frame; a film of 25 mm behind 35 mm.
inline PerspectiveView cornell_view(int width) {
  return {{-0.278, -0.8, 0.273},
          {-0.278, 0.0, 0.273},
          Angle::radians(2.0 * std::atan(0.5 * 0.025 / 0.035)),
          width,
          width};
}

/// The picture by radiosity.
/// @param tolerance_pct       of the picture
/// @param mesh_tolerance_pct  of the solution, which tells how long elements are
inline RenderedView cornell_by_radiosity(const LitScene& lit, int width, double tolerance_pct,
                                         double mesh_tolerance_pct) {
  SceneReflection reflection(lit, Reflection::Radiosity);
  ViewRequest request;
  request.view = cornell_view(width);
  request.tolerance_pct = tolerance_pct;
  IlluminanceOptions options;
  options.tolerance_pct = mesh_tolerance_pct;
  request.reflection = reflection.finder(options, request.method);
  Progress quiet;
  return render_view(request, lit.engines(), lit.source(), nullptr, quiet);
}

}  // namespace tenku::testing_support
