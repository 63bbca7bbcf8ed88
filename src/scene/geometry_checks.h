/// What a model has that the methods of light bear badly: told, not mended.
#pragma once

#include <string>

#include "scene/raw_scene.h"

namespace tenku {

/// Adds findings of a scene that is placed and mended, before a ground is added:
///  - `coincident_faces`: faces of two objects with the same vertices, such as a wall that two
///    buildings share. Faces that overlap in part are not found.
///  - `far_from_origin`: parts beyond 16 km from the local origin, where positions in 32-bit floats
///    (the ray engine's) lie more than 1 mm apart. The object farthest from the middle of the
///    scene is named; the middle is the median of its vertices.
///  - `flat_city`: buildings without height.
///  - `huge_triangle`: edges beyond 5 km and a hundred times the usual one.
/// Places are in the coordinates of the file.
///
/// Cost     0.1 s per million surfaces.
void check_geometry(RawScene& raw);

/// A local point in the coordinates of the file, as findings name places.
std::string place_in_file(const Scene& scene, Vec3 local);

}  // namespace tenku
