/// A camera path into a store of lit points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/finding.h"
#include "core/progress.h"
#include "flythrough/point_lighting.h"
#include "flythrough/point_splat.h"
#include "flythrough/point_store.h"

namespace tenku {

struct FlyThroughRequest {
  std::filesystem::path file;  ///< the store when it is complete; until then `file`.part
  bool resume = false;         ///< go on with `file`.part
  StoreHeader header;          ///< all but the setting `light`, which is planned
  StoreLighting lighting;
  PointLightOptions light;
  LightMethod method;
  SplatRule rule;
  std::size_t points_in_chunk = 65536;
  std::size_t points_in_batch = 262144;  ///< after which what was gathered is lit and written
  std::size_t frames_in_batch = 256;
  std::size_t points_in_memory = 16'000'000;  ///< drawn ones of 32 bytes; more are read again
};

/// What it came to.
struct FlyThroughResult {
  std::size_t frames = 0, points = 0, chunks = 0;
  std::size_t frames_before = 0;  ///< that a run before this one did
  std::uint64_t bytes = 0, rays = 0;
  double gather_s = 0.0, light_s = 0.0;  ///< clock time
  std::string how;                       ///< `PointLightPlan` as text
  std::vector<Finding> findings;
};

/// Gathers points frame by frame, lights them in batches, and appends them chunk by chunk.
///
/// The order of the work depends on the request alone: killed at any moment and resumed, a run
/// makes the same bits as one that was left alone. A kill loses the chunk that is being lit, and
/// the points of its batch are gathered again.
///
/// @throws InputError     cannot be resumed: another scene, path or setting, which it names
/// @throws ResourceError  disk, memory or an engine fails
/// @throws Cancelled      if the user asks to stop; what is written can be resumed
FlyThroughResult fly_through(const FlyThroughRequest& request, const Engines& engines,
                             const DaylightSource& source, Progress& progress);

/// `file`.part; `file` itself where it is a device.
std::filesystem::path part_of(const std::filesystem::path& file);

}  // namespace tenku
