/// The surfaces of a scene as beams meet them: convex flat faces.
#pragma once

#include <cstdint>
#include <vector>

#include "beams/beam_view.h"
#include "beams/face_tree.h"
#include "scene/material.h"
#include "scene/triangle_soup.h"

namespace tenku {

/// A convex polygon of one object and material.
///
/// Frame    counter-clockwise seen from the side to which the plane's normal points.
struct BeamFace {
  std::vector<Vec3> corners;
  Plane plane;
  std::uint32_t object = 0, material = 0;
  std::vector<std::uint32_t> triangles;  ///< of the soup, those joined here
  bool is_mirror = false;                ///< sends light on: an opaque mirror or a pane
  bool is_pane = false;                  ///< lets it through too
};

/// Faces of a scene, and a tree of boxes over them.
///
/// Neighbouring triangles in one plane that share an edge, object and material are joined as long
/// as they stay convex: how the file divides a pane is of no matter. Triangles without area are
/// left out.
///
/// Source   greedy removal of diagonals: S. Hertel and K. Mehlhorn, FCT 1983.
/// Threads  immutable after construction; may be shared.
/// Cost     1 us a triangle.
class BeamFaces {
 public:
  /// @throws nothing of its own; a soup without triangles gives no faces
  BeamFaces(const TriangleSoup& soup, const std::vector<Material>& materials);

  const std::vector<BeamFace>& faces() const { return faces_; }
  const BeamFace& operator[](std::size_t face) const { return faces_[face]; }
  const FaceTree& tree() const { return tree_; }
  std::size_t mirrors() const { return mirrors_; }
  const Material& material_of(const BeamFace& face) const { return materials_[face.material]; }

  /// Largest coordinate, metres: what rounding is measured by.
  double extent_m() const { return extent_m_; }

 private:
  std::vector<BeamFace> faces_;
  std::vector<Material> materials_;
  FaceTree tree_;
  std::size_t mirrors_ = 0;
  double extent_m_ = 1.0;
};

}  // namespace tenku
