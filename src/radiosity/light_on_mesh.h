/// A solution as those take it who ask for another mesh.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "meshing/element_mesh.h"
#include "radiosity/interior.h"
#include "radiosity/side_points.h"

namespace tenku {

/// Illuminance at the corners of elements, where any light reaches the plane.
///
/// Units    lux.
/// Shape    [point] but for `middle_off`.
struct LightOnMesh {
  const ElementMesh& mesh;
  const SidePoints& points;
  std::vector<double> lux, variance;
  std::vector<std::uint8_t> is_lit;
  std::vector<double> middle_off;       ///< [element side], as in `CornerLight`
  std::vector<double> direct_variance;  ///< lux^2, of the light that `middle_off` compares
};

/// @param mesh, interior  kept by reference
LightOnMesh light_on_mesh(const ElementMesh& mesh, const Interior& interior,
                          const InteriorLight& light);

/// Area-weighted mean over all lit sides, lux; 0 where none is.
double mean_lux(const LightOnMesh& light);

/// Mean of the corners of a side, lux.
double side_lux(const LightOnMesh& light, std::size_t side);

/// The points that an edge leads to from each one, on lit sides.
class PointNeighbours {
 public:
  explicit PointNeighbours(const LightOnMesh& light);
  /// In rising order.
  std::span<const std::uint32_t> of(std::uint32_t point) const {
    return std::span(neighbour_).subspan(begin_[point], begin_[point + 1] - begin_[point]);
  }

 private:
  std::vector<std::uint32_t> neighbour_;
  std::vector<std::size_t> begin_;
};

/// The mesh vertex of each point.
std::vector<std::uint32_t> vertices_of(const LightOnMesh& light);

}  // namespace tenku
