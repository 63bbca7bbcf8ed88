#include "scene/scene.h"

namespace tenku {

Vec3 area_vector(const Scene& scene, std::size_t s) {
  const Surfaces& surfaces = scene.surfaces;
  const Vec3 origin = scene.vertices[surfaces.outer_ring(s)[0]];
  Vec3 doubled{};
  for (std::size_t r = surfaces.first_ring[s]; r < surfaces.first_ring[s + 1]; ++r) {
    const auto ring = surfaces.ring(r);
    Vec3 last = scene.vertices[ring.back()] - origin;
    for (const std::uint32_t v : ring) {
      const Vec3 next = scene.vertices[v] - origin;
      doubled = doubled + cross(last, next);
      last = next;
    }
  }
  return 0.5 * doubled;
}

Extent extent_of_surfaces(const Scene& scene) {
  Extent box;
  for (const std::uint32_t v : scene.surfaces.vertex) box.add(scene.vertices[v]);
  return box;
}

SurfaceType type_by_normal(Vec3 normal) {
  constexpr double kSin10Degrees = 0.17364817766693033;
  const double up = normal.z / length(normal);
  if (up > kSin10Degrees) return SurfaceType::Roof;
  return up < -kSin10Degrees ? SurfaceType::Ground : SurfaceType::Wall;
}

}  // namespace tenku
