#include "form_factors/outward_view.h"

namespace tenku {

OutwardView::OutwardView(const ElementMesh& mesh, double lift_m) : lift_m_(lift_m) {
  for (const auto& corners : mesh.elements) {
    for (const std::uint32_t v : corners) extent_.add(mesh.vertices[v]);
  }
}

bool OutwardView::faces_nothing(Vec3 position, Vec3 normal) const {
  const Vec3 farthest{normal.x > 0.0 ? extent_.max.x : extent_.min.x,
                      normal.y > 0.0 ? extent_.max.y : extent_.min.y,
                      normal.z > 0.0 ? extent_.max.z : extent_.min.z};
  return !(dot(normal, farthest - position) > lift_m_);
}

}  // namespace tenku
