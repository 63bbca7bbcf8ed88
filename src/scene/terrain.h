/// Terrain from elevation models, under and around a city.
#pragma once

#include <filesystem>
#include <vector>

#include "core/progress.h"
#include "scene/raw_scene.h"

namespace tenku {

/// Of the tolerance, that each part of the far skyline may take.
inline constexpr double kSkylineShare = 0.1;
/// A skyline that is wrong by this all around takes `kSkylineShare` of the tolerance from the light
/// of a wall, radians: a horizon that is higher by an angle takes 4 / pi of it.
double skyline_angle(double tolerance_pct);

/// Adds elevation models to a scene that is placed, each as one object of type
/// `TINRelief`, and sets the buildings on them.
///
/// Pixels are brought into the reference system of the scene, without grids (about 1 m); their
/// heights stay above the datum of their file. Under the city all pixels are taken; around it
/// triangles leave them by no more than an angle seen from the city, a share of the tolerance
/// (docs/scene_files.md), and the Earth's curvature lowers them, less the usual refraction. Where
/// the city has terrain of its own, that is kept.
///
/// Findings `terrain_hole`, `terrain_without_crs`, `off_terrain`, `feet_lowered`,
/// `set_on_terrain`, `terrain_levelled`.
///
/// @throws InputError  if a file cannot be read, lies elsewhere, or has a reference system where
///                     the scene has none
void add_terrain(RawScene& raw, const std::vector<std::filesystem::path>& files,
                 const ReadOptions& options, Progress& progress);

}  // namespace tenku
