/// The region at each sample of a picture.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "beams/beam_tree.h"

namespace tenku {

/// Regions of a window of `width` x `height` pixels, looked up at the same places in each pixel.
///
/// Shape    [row][column][place], row-major.
class RegionMap {
 public:
  /// @param places  in the pixel, 0 to 1
  RegionMap(const BeamTree& tree, int width, int height, std::span<const WindowPoint> places);

  std::uint32_t at(std::size_t pixel, std::size_t place) const {
    return region_[pixel * places_ + place];
  }

 private:
  void fill_rows(const BeamTree& tree, int first, int last, std::span<const WindowPoint> places);

  int width_;
  std::size_t places_;
  std::vector<std::uint32_t> region_;
};

}  // namespace tenku
