/// Sorting of many records by hashes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/parallel.h"

namespace tenku {

/// Sorts records by `<`, which compares their `key` first.
///
/// The upper bits of the keys spread the records over buckets that are sorted one by one: several
/// times faster than one sort of all where every bit of a key is random, and right where not.
template <class Record>
void sort_by_mixed_key(std::vector<Record>& records) {
  constexpr int kBits = 12;
  constexpr std::size_t kBuckets = std::size_t{1} << kBits, kGrain = 64;
  const auto bucket_of = [](const Record& r) { return r.key >> (64 - kBits); };
  std::vector<std::size_t> end(kBuckets + 1, 0);
  for (const Record& r : records) ++end[bucket_of(r) + 1];
  for (std::size_t b = 0; b < kBuckets; ++b) end[b + 1] += end[b];
  std::vector<Record> spread(records.size());
  for (const Record& r : records) spread[end[bucket_of(r)]++] = r;
  records.swap(spread);
  parallel_for(kBuckets, kGrain, [&](IndexRange range) {
    for (std::size_t b = range.begin; b < range.end; ++b) {
      const auto at = [&](std::size_t i) {
        return records.begin() + static_cast<std::ptrdiff_t>(i);
      };
      std::sort(at(b == 0 ? 0 : end[b - 1]), at(end[b]));
    }
  });
}

}  // namespace tenku
