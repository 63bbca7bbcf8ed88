/// The region at each sample of a picture.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "beams/beam_tree.h"

namespace tenku {

/// Regions of a window of `width` x `height` pixels, looked up at the same places in each pixel.
///
/// Each place has one region of layer 0, and where panes mirror one more for each layer that is
/// seen there.
///
/// Shape    [row][column][place], row-major.
class RegionMap {
 public:
  /// @param places  in the pixel, 0 to 1
  RegionMap(const BeamTree& tree, int width, int height, std::span<const WindowPoint> places);

  std::uint32_t at(std::size_t pixel, std::size_t place) const {
    return region_[pixel * places_ + place];
  }

  /// The regions of other layers, in the order of the layers.
  std::span<const std::uint32_t> mirrored_at(std::size_t pixel, std::size_t place) const;

 private:
  /// Regions of the other layers at the places of some rows.
  struct Band {
    std::vector<std::uint32_t> first;  ///< of `region`, [place of the band + 1]; or none at all
    std::vector<std::uint32_t> region;
  };

  void fill_rows(const BeamTree& tree, int first, int last, std::span<const WindowPoint> places);
  Band mirrored_in(const BeamTree& tree, int first, int last,
                   std::span<const WindowPoint> places) const;

  int width_;
  std::size_t places_;
  std::vector<std::uint32_t> region_;
  std::vector<std::uint32_t> mirrored_;  ///< regions of other layers, by layer
  std::vector<Band> bands_;
};

}  // namespace tenku
