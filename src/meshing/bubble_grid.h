/// Bubbles of any size that can be asked for by where they are.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshing/flat_polygon.h"

namespace tenku {

/// Cells in one hash table, of widths that double from level to level; a bubble is in one cell of
/// the first level that is no narrower than it.
///
/// Cost     constant for each bubble and question, whatever the sizes, where neighbours are not of
///          sizes that differ much.
class BubbleGrid {
 public:
  static constexpr double kAnyRatio = 1e6;
  /// Bubbles so many times smaller than what they are asked near to need not be found in any case:
  /// there could be any number of them.
  static constexpr double kMostFiner = 2.0;

  /// @param most_ratio  of sizes: bubbles that are so many times larger or smaller than what they
  ///                    are asked near to need not be found
  explicit BubbleGrid(std::size_t expected, double most_ratio = kAnyRatio)
      : first_(std::bit_ceil(std::max<std::size_t>(2 * expected, 64)), kEnd),
        most_ratio_(most_ratio) {
    entries_.reserve(expected);
  }

  void insert(std::uint32_t id, PlanePoint at, double size_m) {
    const int level = level_of(size_m);
    lowest_ = entries_.empty() ? level : std::min(lowest_, level);
    highest_ = entries_.empty() ? level : std::max(highest_, level);
    const double per_m = 1.0 / width_of(level);
    Entry entry{coordinate(at.x * per_m), coordinate(at.y * per_m), level, id, kEnd};
    std::uint32_t& first = first_[bucket(entry.x, entry.y, level)];
    entry.next = first;
    first = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back(entry);
  }

  /// Calls `visit(id)` for bubbles whose centre may be nearer to `p` than `reach` times the mean of
  /// `size_m` and their size: for no fewer.
  template <class Visit>
  void for_each_near(PlanePoint p, double size_m, double reach, const Visit& visit) const {
    const double largest = most_ratio_ * size_m;
    const int finest = std::max(lowest_, level_of(size_m / std::min(most_ratio_, kMostFiner)));
    const int coarsest = std::min(highest_, level_of(largest));
    for (int level = finest; level <= coarsest; ++level) {
      visit_box(p, 0.5 * reach * (size_m + std::min(width_of(level), largest)), level, visit);
    }
  }

  /// Calls `visit(id)` for bubbles that may have `p` in them: for no fewer.
  template <class Visit>
  void for_each_about(PlanePoint p, const Visit& visit) const {
    for (int level = lowest_; level <= highest_; ++level) {
      visit_box(p, 0.5 * width_of(level), level, visit);
    }
  }

 private:
  static constexpr std::uint32_t kEnd = 0xffffffffU;
  struct Entry {
    std::int64_t x, y;
    int level;
    std::uint32_t id, next;
  };

  static int level_of(double size_m) { return std::ilogb(size_m) + 1; }
  static double width_of(int level) { return std::ldexp(1.0, level); }
  static std::int64_t coordinate(double x) {
    constexpr double kMost = 4e18;  // what 64 bits hold
    return static_cast<std::int64_t>(std::clamp(std::floor(x), -kMost, kMost));
  }
  std::size_t bucket(std::int64_t x, std::int64_t y, int level) const {
    const auto key = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15U +
                     static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fU +
                     static_cast<std::uint64_t>(level + 4096);
    return (key ^ (key >> 29U)) & (first_.size() - 1);
  }
  template <class Visit>
  void visit_box(PlanePoint p, double far, int level, const Visit& visit) const {
    const double per_m = 1.0 / width_of(level);
    const auto x1 = coordinate((p.x + far) * per_m), y1 = coordinate((p.y + far) * per_m);
    for (auto y = coordinate((p.y - far) * per_m); y <= y1; ++y) {
      for (auto x = coordinate((p.x - far) * per_m); x <= x1; ++x) visit_cell(x, y, level, visit);
    }
  }
  template <class Visit>
  void visit_cell(std::int64_t x, std::int64_t y, int level, const Visit& visit) const {
    for (std::uint32_t i = first_[bucket(x, y, level)]; i != kEnd; i = entries_[i].next) {
      const Entry& e = entries_[i];
      if (e.x == x && e.y == y && e.level == level) visit(e.id);
    }
  }

  std::vector<std::uint32_t> first_;  ///< [bucket]
  std::vector<Entry> entries_;
  double most_ratio_;
  int lowest_ = 0, highest_ = -1;  ///< levels
};

}  // namespace tenku
