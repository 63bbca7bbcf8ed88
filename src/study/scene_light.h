/// Light on the sensors of a scene with all its reflections, by the way that suits the scene.
#pragma once

#include <memory>
#include <optional>

#include "core/progress.h"
#include "illuminance/light_method.h"
#include "illuminance/planned_light.h"
#include "illuminance/sensor.h"
#include "radiosity/interior.h"
#include "study/lit_scene.h"

namespace tenku {

/// Sensors of one scene under one sky. Radiosity is solved when the first of them need it, to
/// their tolerance, and kept.
class SceneLight {
 public:
  /// @param lit  kept by reference
  SceneLight(const LitScene& lit, Reflection reflection);

  /// As `illuminate` of a plan. By radiosity reflections are all there, however many
  /// `options.bounces` asks for, if it asks for five or more; fewer are followed as paths.
  IlluminanceResult illuminate(const Sensors& sensors, const IlluminanceOptions& options,
                               const LightMethod& method, Progress& progress);

 private:
  bool is_by_radiosity(const IlluminanceOptions& options) const;
  void solve(const IlluminanceOptions& direct, const LightMethod& method, Progress& progress);

  const LitScene& lit_;
  Reflection reflection_;
  std::unique_ptr<ElementMesh> mesh_;
  std::unique_ptr<Interior> interior_;
  std::optional<InteriorLight> light_;
  std::vector<Finding> findings_;
};

}  // namespace tenku
