/// The scene as the light meets it: triangles, with the way back to the object.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec3.h"
#include "scene/surface_type.h"

namespace tenku {

/// Triangles of a scene, flattened once.
///
/// Frame    local east, north, up; counter-clockwise seen from outside (front).
/// Units    metres.
/// Shape    per-triangle arrays all have `triangles.size()` entries; vertices are shared where
///          the file shares them, so that neighbours can be found by index.
struct TriangleSoup {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> object;  ///< index into `Scene::objects`
  std::vector<SurfaceType> surface_type;
  std::vector<std::uint32_t> material;  ///< index into `Scene::materials`

  std::size_t size() const { return triangles.size(); }
};

}  // namespace tenku
