#include "flythrough/chunk_cache.h"

#include <algorithm>

namespace tenku {

ChunkCache::ChunkCache(const PointStoreWriter& store, std::size_t most_points)
    : store_(store), most_(most_points) {}

std::vector<const SplatChunk*> ChunkCache::shown(const SplatBuffer& buffer, std::size_t chunks) {
  slots_.resize(chunks);
  ++calls_;
  std::vector<const SplatChunk*> found;
  for (std::size_t c = 0; c < slots_.size(); ++c) {
    const ChunkInfo& info = store_.chunks()[c];
    if (!buffer.may_show(info.extent, info.finest_m)) continue;
    Slot& slot = slots_[c];
    slot.used = calls_;
    if (!slot.is_held) {
      slot.chunk = splat_chunk(store_.points(c));
      slot.is_held = true;
      held_ += info.points;
    }
    found.push_back(&slot.chunk);
  }
  drop_oldest(calls_);
  return found;
}

void ChunkCache::drop_oldest(std::size_t now) {
  while (held_ > most_) {
    const auto oldest =
        std::min_element(slots_.begin(), slots_.end(), [](const auto& a, const auto& b) {
          return (a.is_held ? a.used : ~std::size_t{0}) < (b.is_held ? b.used : ~std::size_t{0});
        });
    if (!oldest->is_held || oldest->used == now) return;  // all are needed
    held_ -= oldest->chunk.points.size();
    *oldest = {};
  }
}

}  // namespace tenku
