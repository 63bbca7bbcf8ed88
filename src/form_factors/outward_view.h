/// Which points have a whole mesh behind them.
#pragma once

#include "core/extent.h"
#include "meshing/element_mesh.h"

namespace tenku {

/// Tells points that face out of the mesh: what they send escapes, and no ray need be traced.
class OutwardView {
 public:
  /// @param lift_m  of the points off their surface
  OutwardView(const ElementMesh& mesh, double lift_m);

  /// Whether nothing of the mesh lies in front of the point: false where the box about the mesh
  /// does not tell.
  bool faces_nothing(Vec3 position, Vec3 normal) const;

 private:
  Extent extent_;
  double lift_m_;
};

}  // namespace tenku
