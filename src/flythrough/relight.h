/// Another hour on the points of a store.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/progress.h"
#include "flythrough/point_lighting.h"
#include "flythrough/point_store.h"

namespace tenku {

struct RelightResult {
  std::size_t lighting = 0;  ///< its index in the store
  std::size_t points = 0, chunks = 0;
  std::uint64_t bytes = 0;  ///< of the store
};

/// Adds the light of another sun and sky to a complete store, in place and chunk by chunk: cut off,
/// the store keeps what it had, and the same call goes on.
///
/// @param scene_sha256  of the scene that the engines hold
/// @throws InputError     the store is of another scene or not complete, or has this lighting
/// already
/// @throws ResourceError, Cancelled  as `fly_through`
RelightResult relight(const std::filesystem::path& file, const std::string& scene_sha256,
                      const StoreLighting& lighting, const PointLightOptions& options,
                      const Engines& engines, const DaylightSource& source, Progress& progress);

/// @throws InputError if the store was made from another scene, naming both
void check_scene(const PointStore& store, const std::string& scene_sha256,
                 const std::string& store_name);

}  // namespace tenku
