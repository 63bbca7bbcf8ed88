/// How meshes suit the light, as a page.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "radiosity/mesh_loop.h"

namespace tenku {

/// A solved mesh and its name on the page.
using NamedMesh = std::pair<std::string, const MeshLoop*>;

/// The page of `mesh_page`: all meshes from the same eye, above the south-west. Faces on the
/// outside of the scene's box are left out, so that one looks into a room. White is what a
/// twentieth of the lit area of the first mesh, without lamps, is brighter than.
/// @param meshes  at least one
std::string mesh_report(const std::string& title, const std::vector<NamedMesh>& meshes);

}  // namespace tenku
