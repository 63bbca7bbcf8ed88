/// The panels of a scene that mirror the sun.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/material.h"
#include "scene/triangle_soup.h"
#include "visibility/mesh_adjacency.h"

namespace tenku {

/// Whether a material mirrors: `mirror`, or the panes of glass by `index` or `transmittance`.
bool is_mirror(const Material& material);

/// Share of the light that a surface mirrors at a cosine of incidence.
///
/// Of `mirror` and `mirror_index` the luminance of `mirror_reflectance`; of glass, Fresnel's
/// formulas for a pane with both faces and no absorption. A pane that is told by its transmittance
/// mirrors what one of index 1.52 does. Source   `pane_transmittance`.
double mirrored_share(const Material& material, double cos_incidence);

/// Convex flat piece of a panel.
struct MirrorPart {
  std::vector<Vec3> corners;  ///< counter-clockwise from the front
  Vec3 normal;                ///< unit, the front side
};

/// One panel: triangles of one object and material that join edge to edge within a tenth of a
/// degree. It mirrors on both sides.
struct MirrorPanel {
  std::uint32_t object = 0, material = 0;
  Vec3 normal;  ///< unit, the mean
  Vec3 middle;
  double area_m2 = 0.0;
  std::vector<MirrorPart> parts;  ///< do not overlap
};

/// All panels of a scene, in the order of their first triangles. Triangles of no area are left out,
/// and those with the corners of an earlier one.
std::vector<MirrorPanel> mirror_panels(const TriangleSoup& soup,
                                       const std::vector<Material>& materials,
                                       const MeshAdjacency& adjacency);

}  // namespace tenku
