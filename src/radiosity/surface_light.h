/// What the surfaces of a mesh do to light, ready to calculate with.
#pragma once

#include <cstddef>
#include <vector>

#include "core/finding.h"
#include "core/rgb.h"
#include "meshing/element_mesh.h"
#include "scene/material.h"

namespace tenku {

/// Areas, reflectances and exitances of elements.
///
/// Shape    every array [element].
struct SurfaceLight {
  std::vector<double> area_m2;
  std::vector<Rgb> reflectance;     ///< diffuse; a mirror's share is counted as diffuse
  std::vector<Rgb> emission_lm_m2;  ///< of each side
  double most_reflectance = 0.0;    ///< of all channels and elements
  bool any_emits = false;

  bool emits(std::size_t element) const { return luminance_of(emission_lm_m2[element]) > 0.0; }
};

/// @param findings  is told of mirrors
SurfaceLight surface_light(const ElementMesh& mesh, const std::vector<Material>& materials,
                           std::vector<Finding>& findings);

}  // namespace tenku
