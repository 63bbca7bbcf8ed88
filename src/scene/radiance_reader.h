/// Reader of Radiance scene descriptions.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "scene/raw_scene.h"

namespace tenku {

/// Reads the polygons of a `.rad` file and their materials. Commands in it are not run; other
/// shapes, patterns and textures are told and left out.
///
/// Source   G. J. Ward, "The RADIANCE 5.x Synthetic Imaging System" (the reference manual),
/// sections
///          on scene descriptions, surface types and material types.
/// @throws InputError  naming file and line, and as `read_input_file`
RawScene read_radiance(const std::filesystem::path& path, Progress& progress);

/// The material that a Radiance primitive describes; nothing if it is of a type without a
/// counterpart here.
///
/// `plastic` and `metal`: what is specular and not rough mirrors, what is rough joins the diffuse
/// part. `glass`: transmissivity becomes transmittance at normal incidence by the reflections
/// between the faces of a pane. `mirror`; `light` and `glow`: exitance, at 179 lm/W.
///
/// Source   the same, section on material types; for glass the sum over reflections,
///          T = t (1 - r)^2 / (1 - r^2 t^2), r = ((n - 1) / (n + 1))^2.
/// @throws InputError  if the numbers are too few or outside what is possible
std::optional<Material> radiance_material(const std::string& type,
                                          const std::vector<double>& numbers);

}  // namespace tenku
