/// From the surfaces of a scene to elements and patches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/finding.h"
#include "meshing/element_mesh.h"
#include "meshing/flat_polygon.h"
#include "scene/material.h"
#include "scene/scene.h"
#include "scene/triangle_soup.h"

namespace tenku {

/// How finely surfaces are divided. Lengths in metres; 0 where it is not given.
struct MeshOptions {
  double element_m = 0.0;        ///< longest edge of an element (`--size-max`)
  double element_min_m = 0.0;    ///< what is chosen for it is no less than this (`--size-min`)
  double patch_m = 0.0;          ///< longest diagonal of a patch
  std::size_t elements_max = 0;  ///< not to be passed (`--elements-max`)
  double tolerance_pct = 2.0;    ///< of what is calculated on it: goes into the size that is chosen
};

/// A mesh, and what is to be told of it.
struct MeshedScene {
  ElementMesh mesh;
  MeshOptions sizes;              ///< as chosen
  std::vector<Finding> findings;  ///< see surface_flaw.h, and `elements_max_passed`
  std::vector<FlatPolygon> polygons;
  std::vector<std::uint32_t> polygon_of;  ///< [element], in rising order
};

/// Divides all surfaces but glass.
///
/// Neighbouring triangles in one plane that have the same material and object are one polygon,
/// however the file divides it. Within a polygon elements share their vertices, and no vertex lies
/// on an edge that it does not end; between polygons nothing is shared. A polygon that is cut into
/// rectangles by lines from its corners gets regular right triangles, any other a Delaunay
/// triangulation. Where triangles of a polygon overlap, each is divided by itself. The same input
/// gives the same mesh, for any number of threads.
///
/// An element is as long as given. Where it is not given it is as long as `elements_max` allows, or
/// without that a 32nd of the scene's longest side at a tolerance of 2 % (half to four times that,
/// as the tolerance to the power 0.75), or what allows 50,000 elements more than the polygons need
/// in any case. Where more than `elements_max` come out all the same, elements are made longer. A
/// patch is twice as long as an element where it is not given.
///
/// @throws InputError  a size that is negative or not finite; sizes that would give more than a
///                     hundred million elements; a material that `scene` does not have
/// Cost     2 us per triangle of the soup, 1 us per element, and 5 us per element of polygons that
///          are not rectangular
MeshedScene mesh_scene(const Scene& scene, const TriangleSoup& soup, const MeshOptions& options);

/// The mesh alone, without the checks.
ElementMesh mesh_surfaces(const TriangleSoup& soup, std::span<const Material> materials,
                          const MeshOptions& options);

}  // namespace tenku
