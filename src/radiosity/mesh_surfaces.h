/// From the surfaces of a scene to elements and patches.
#pragma once

#include <cstddef>
#include <span>

#include "radiosity/element_mesh.h"
#include "scene/material.h"
#include "scene/triangle_soup.h"

namespace tenku {

/// How finely surfaces are divided. Lengths in metres; 0 where it is not given.
struct MeshOptions {
  double element_m = 0.0;        ///< longest edge of an element (`--size-max`)
  double element_min_m = 0.0;    ///< what is chosen for it is no less than this (`--size-min`)
  double patch_m = 0.0;          ///< longest diagonal of a patch; twice that of an element
  std::size_t elements_max = 0;  ///< not to be passed (`--elements-max`)
};

/// The sizes that stand where none are given.
///
/// An edge of an element is as long as `elements_max` allows; without that, a 32nd of the scene's
/// longest side, or what 50,000 elements allow.
MeshOptions chosen_sizes(const TriangleSoup& soup, std::span<const Material> materials,
                         const MeshOptions& options);

/// Divides all surfaces but glass.
///
/// Neighbouring triangles in one plane that have the same material and object are one polygon,
/// however the file divides it. Within a polygon elements share their vertices, and no vertex lies
/// on an edge that it does not end; between polygons nothing is shared. A polygon that is cut into
/// rectangles by lines from its corners gets regular right triangles, any other a Delaunay
/// triangulation. The same input gives the same mesh, for any number of threads.
///
/// @throws InputError  a size that is negative or not finite, or a material not in `materials`
/// Cost     about 5 us per element of a polygon that is not rectangular, 0.1 us of others.
ElementMesh mesh_surfaces(const TriangleSoup& soup, std::span<const Material> materials,
                          const MeshOptions& options);

}  // namespace tenku
