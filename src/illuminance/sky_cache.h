/// Skylight on surfaces, roughly: a guess that path tracing corrects.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

#include "core/vec3.h"
#include "illuminance/daylight_source.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// Direct skylight on the surfaces of a scene, one value a cell, found when it is first asked for.
///
/// A cell is the part of one side of one triangle in a cube of a grid whose pitch suits the
/// distance from which it is seen. Its value belongs to one point of it and is the same whoever
/// asks first.
///
/// Error    not bounded: whoever uses it corrects it by true values.
/// Threads  may be shared; look-ups lock one of many shards.
class SkyCache {
 public:
  SkyCache(const RayVisibility& rays, const DaylightSource& source, std::uint64_t seed);
  ~SkyCache();

  /// Illuminance (lux) from the visible sky near `point` of `triangle`, on the side to which
  /// `normal` points, for someone at `distance_m`.
  double lux(std::uint32_t triangle, Vec3 point, Vec3 normal, double distance_m);

  const DaylightSource& source() const { return source_; }
  std::uint64_t rays_sent() const { return rays_sent_; }

 private:
  struct Shard;
  static constexpr std::size_t kShards = 256;

  double measure(Vec3 point, Vec3 normal, std::uint64_t key);

  const RayVisibility& rays_;
  const DaylightSource& source_;
  std::uint64_t seed_;
  std::unique_ptr<std::array<Shard, kShards>> shards_;
  std::atomic<std::uint64_t> rays_sent_{0};
};

}  // namespace tenku
