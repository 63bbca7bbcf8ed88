/// Chunks of a store that is being written, ready to be drawn.
#pragma once

#include <cstddef>
#include <vector>

#include "flythrough/point_splat.h"
#include "flythrough/point_store.h"

namespace tenku {

/// Holds those used last, up to a number of points; others are read again from the store.
class ChunkCache {
 public:
  /// @param store  kept by reference
  ChunkCache(const PointStoreWriter& store, std::size_t most_points);

  /// Of the first `chunks` those that may show, in their order. Valid until the next call.
  std::vector<const SplatChunk*> shown(const SplatBuffer& buffer, std::size_t chunks);

 private:
  struct Slot {
    SplatChunk chunk;
    bool is_held = false;
    std::size_t used = 0;
  };
  void drop_oldest(std::size_t now);

  const PointStoreWriter& store_;
  std::size_t most_, held_ = 0, calls_ = 0;
  std::vector<Slot> slots_;
};

}  // namespace tenku
