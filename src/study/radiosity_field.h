/// Radiosity as fields for ParaView.
#pragma once

#include <span>

#include "output/field_writer.h"
#include "radiosity/interior.h"
#include "study/lit_scene.h"

namespace tenku {

/// Both sides of every element that light reaches, each a polygon that faces its way, lifted by as
/// much as the rays.
///
/// Point arrays `sun_lux`, `sky_lux`, `reflected_lux`, `total_lux`, `illuminance_lux` (the total
/// again), `error_lux`, `sky_view`; `radiosity_lm_m2` and, in linear Rec. 709,
/// `radiosity_r_lm_m2`, `radiosity_g_lm_m2`, `radiosity_b_lm_m2`. Values are continuous over each
/// plane of one material. Cell arrays of the elements: `element_radiosity_lm_m2`, `unshot_lm_m2`
/// (what the last shot left), `patch`, `side` (0 front, 1 back), `surface_type`, `object_id`,
/// `material`, `element_size_m` (mean length of its edges). Texts as those of `field_of_grid`.
/// @param asked_size_m  [vertex], for the point array `asked_size_m`; empty: none
FieldMesh field_of_radiosity(const LitScene& lit, const ElementMesh& mesh, const Interior& interior,
                             const InteriorLight& light, std::span<const double> asked_size_m = {});

/// Elements as the shots have left them, with the ambient light of what is unshot: cell arrays
/// `radiosity_lm_m2`, `with_ambient_lm_m2`, `unshot_lm_m2`, `side`.
FieldMesh field_of_shots(const LitScene& lit, const ElementMesh& mesh, const SurfaceLight& surfaces,
                         const ShotView& view);

}  // namespace tenku
