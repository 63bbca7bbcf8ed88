/// A picture of which thing is nearest.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace tenku {

/// Number and nearness of the nearest thing of each pixel.
///
/// Shape  [row][column].
class ItemBuffer {
 public:
  static constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();

  ItemBuffer(int rows, int columns)
      : columns_(static_cast<std::size_t>(columns)),
        item_(static_cast<std::size_t>(rows) * columns_, kNothing),
        nearness_(item_.size()) {}

  std::size_t index(int row, std::size_t column) const {
    return static_cast<std::size_t>(row) * columns_ + column;
  }

  /// Fills the pixels whose centres lie in a span, x0 <= column + 0.5 < x1, where nothing nearer
  /// is.
  /// @param nearness_at  of a column: positive, and greater where the thing is nearer
  template <class NearnessAt>
  void fill(int row, double x0, double x1, std::uint32_t thing, const NearnessAt& nearness_at) {
    const std::size_t begin = column_from(x0), end = column_from(x1), first = index(row, 0);
    for (std::size_t column = begin; column < end; ++column) {
      const auto nearness = static_cast<float>(nearness_at(column));
      if (nearness <= nearness_[first + column]) continue;
      nearness_[first + column] = nearness;
      item_[first + column] = thing;
    }
  }

  const std::vector<std::uint32_t>& item() const { return item_; }

 private:
  std::size_t column_from(double x) const {
    return static_cast<std::size_t>(
        std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(columns_)));
  }

  std::size_t columns_;
  std::vector<std::uint32_t> item_;
  std::vector<float> nearness_;
};

}  // namespace tenku
