/// A mesh and the light on it, drawn from the same eye.
#pragma once

#include <array>
#include <vector>

#include "core/rgb.h"
#include "core/vec3.h"
#include "view/camera.h"
#include "view/image.h"

namespace tenku {

/// One face of an element, with what it sends at its corners.
struct MeshTriangle {
  std::array<Vec3, 3> corners;  ///< counter-clockwise from where it is seen
  std::array<Rgb, 3> radiosity;
};

/// Both pictures have the same size.
struct MeshPictures {
  Image8 mesh;    ///< edges of elements
  Image8 shaded;  ///< radiosity, linear between corners
};

/// Draws the faces that look at the eye, the nearest in front.
/// @param white  radiosity that is shown white, of any channel; its unit is that of the triangles
MeshPictures draw_mesh(const std::vector<MeshTriangle>& triangles, const PerspectiveView& view,
                       double white);

/// A view of all of it from above the south-west, as wide as it takes.
PerspectiveView view_of_all(const std::vector<MeshTriangle>& triangles, int width, int height);

}  // namespace tenku
