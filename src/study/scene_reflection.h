/// Light between the surfaces of a scene, by the way that suits it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/finding.h"
#include "illuminance/light_method.h"
#include "illuminance/planned_light.h"
#include "radiosity/interior.h"
#include "study/lit_scene.h"

namespace tenku {

/// Whether radiosity suits a scene by itself: no longer than 60 m, no more than 20,000 triangles.
bool is_room(const LitScene& lit);

/// Reflected light of one scene under one sky. Radiosity is solved when the first sensors need it,
/// to their tolerance, and kept.
///
/// Threads  for one at a time.
class SceneReflection {
 public:
  /// @param lit  kept by reference
  SceneReflection(const LitScene& lit, Reflection how);
  SceneReflection(const SceneReflection&) = delete;
  SceneReflection& operator=(const SceneReflection&) = delete;

  /// What `IlluminanceOptions::reflection` is to be: none where paths are followed. By radiosity
  /// all reflections are there, however many `options.bounces` asks for, if it asks for five or
  /// more; fewer are followed as paths.
  const ReflectionFinder* finder(const IlluminanceOptions& options, const LightMethod& method);

  /// Appends what meshing and solving have found since the last call.
  void tell(std::vector<Finding>& findings);

 private:
  bool is_by_radiosity(int bounces) const;
  void solve(Progress& progress);
  void tell_of_lamps();

  const LitScene& lit_;
  Reflection how_;
  IlluminanceOptions direct_;
  LightMethod method_;
  std::unique_ptr<ElementMesh> mesh_;
  std::unique_ptr<Interior> interior_;
  std::optional<InteriorLight> light_;
  ReflectionFinder finder_;
  std::vector<Finding> findings_;
  bool told_of_lamps_ = false;
};

}  // namespace tenku
