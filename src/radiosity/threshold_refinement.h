/// The usual way to a finer mesh: where neighbours differ by more than a threshold, both are split.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshing/mesh_pieces.h"
#include "meshing/split_mesh.h"
#include "radiosity/light_on_mesh.h"

namespace tenku {

/// For each element the greatest difference in illuminance, by the means of corners, to a neighbour
/// across an edge, on either face.
///
/// Source   D. R. Baum, S. Mann, K. P. Smith and J. M. Winget, "Making radiosity usable", SIGGRAPH
///          1991, as T. Itoh et al. (see sizes_by_change.h) take it for comparison.
/// @return  [element], lux
std::vector<double> neighbour_difference(const LightOnMesh& light);

/// A mesh that is refined by splitting: it only ever gets finer, and keeps its patches as long as a
/// patch may be.
class ThresholdRefinement {
 public:
  /// @param polygons  kept by reference
  /// @param pieces    [polygon], the first mesh
  ThresholdRefinement(std::span<const FlatPolygon> polygons, std::span<const MeshPiece> pieces);

  /// Splits the elements of the last mesh whose neighbours differ by more than `threshold_lux` and
  /// gives the pieces of the next one. Does nothing where nothing differs so much.
  /// @param difference    [element of the last mesh]
  /// @param elements_max  the threshold is raised until so many suffice; 0: any number
  /// @param patch_m       longest diagonal of a patch
  /// @return              [polygon]
  std::vector<MeshPiece> refined(std::span<const double> difference, double threshold_lux,
                                 std::size_t elements_max, double patch_m);

 private:
  std::vector<SplitMesh> split(std::span<const double> difference, double threshold_lux) const;
  /// A threshold that so many elements suffice for.
  double enough_lux(std::span<const double> difference, double threshold_lux,
                    std::size_t elements_max) const;

  std::span<const FlatPolygon> polygons_;
  std::vector<SplitMesh> split_;                   ///< [polygon]
  std::vector<std::vector<std::uint32_t>> shown_;  ///< [polygon][element of the mesh], of `split_`
};

}  // namespace tenku
