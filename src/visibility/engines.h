/// Both engines of one scene.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "scene/material.h"
#include "scene/triangle_soup.h"
#include "visibility/ray_visibility.h"
#include "visibility/shadow_maps.h"

namespace tenku {

/// The ray engine, and the shadow-map engine once it is asked for.
///
/// Threads  may be shared.
class Engines {
 public:
  /// @param soup, materials  kept by reference: they must outlive this object
  /// @throws ResourceError as `RayVisibility`
  Engines(const TriangleSoup& soup, const std::vector<Material>& materials,
          GlPlatform platform = GlPlatform::Auto);

  const RayVisibility& rays() const { return rays_; }
  /// @throws ResourceError as `ShadowMaps`, when it is called for the first time
  const ShadowMaps& maps() const;
  /// Shadow maps drawn so far.
  std::uint64_t maps_drawn() const { return maps_ ? maps_->maps_drawn() : 0; }

 private:
  RayVisibility rays_;
  GlPlatform platform_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<ShadowMaps> maps_;
};

}  // namespace tenku
