/// How high the terrain is under a place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/extent.h"
#include "scene/raw_scene.h"

namespace tenku {

/// The triangles of the terrain that lie over a part of the map, found by place.
///
/// Threads  immutable after construction; may be shared. Refers to the vertices of the scene.
class GroundHeights {
 public:
  /// Surfaces of type Ground with three corners, of objects that are no buildings.
  /// @param within  seen from above
  GroundHeights(const RawScene& raw, const Extent& within);

  /// Of the highest there; none where there is no terrain.
  std::optional<double> at(double x, double y) const;
  bool is_any() const { return !triangles_.empty(); }

 private:
  std::size_t column(double x) const;
  std::size_t row(double y) const;

  const std::vector<Vec3>& vertices_;
  Extent box_;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::uint32_t> first_;  // [cell + 1], into `listed_`
  std::vector<std::uint32_t> listed_;
};

}  // namespace tenku
