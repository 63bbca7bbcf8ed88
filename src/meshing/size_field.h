/// How large elements should be, everywhere on a polygon, from what is known of it at some places.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "meshing/flat_polygon.h"

namespace tenku {

/// Size of elements that is asked for at one place.
struct SizeSample {
  PlanePoint at;
  double size_m = 0.0;
};

/// Bounds of a size field.
struct SizeFieldOptions {
  double least_m = 0.0;   ///< no size is less
  double most_m = 0.0;    ///< nor greater
  double grading = 0.25;  ///< the most by which the size changes, metres per metre
};

/// A smooth and positive size over a polygon.
///
/// Source   A. Yamada, K. Shimada, T. Itoh, the size control of bubble meshes that T. Itoh et al.
///          use for radiosity: values on an orthogonal grid that minimise the bending energy of a
///          thin plate, the samples held.
///
/// Here the plate bends in the logarithm of the size, so that sizes are positive; the energy and
/// the squares of what samples miss (bilinear between four nodes, 1,000 times as stiff) make one
/// sparse system. Then sizes are lowered where they rise faster than `grading`, from node to node
/// and from each sample: a small size is never averaged away. Between the bounds and those of the
/// samples.
///
/// The spacing of the grid is the least size of a sample, or more: there are no more nodes than
/// half the samples, but for 64, and than 4,096. Where all samples are equal there is no grid.
///
/// Frame    the plane of the polygon, as `FlatPolygon::flat`.
/// Units    metres.
/// Threads  immutable after construction; may be shared.
/// Cost     a sparse factorisation: 5 to 10 us per node.
class SizeField {
 public:
  /// @param samples  on the polygon; without any the size is `most_m`
  /// @throws InputError  a sample or a bound that is not a positive length, bounds the wrong way
  ///                     round, a grading that is not positive
  SizeField(const FlatPolygon& polygon, std::span<const SizeSample> samples,
            const SizeFieldOptions& options);

  /// Size at a place; off the polygon's box, that at the nearest place of the box.
  double at(PlanePoint p) const;

  /// Nodes of the grid; 0 where the size is the same everywhere.
  std::size_t nodes() const { return size_m_.size(); }
  double spacing_m() const { return spacing_m_; }

 private:
  /// A place in the grid: the lower left node of its cell, and how far it is across the cell.
  struct Cell {
    std::size_t node;
    double x, y;
  };

  void lay_grid(const FlatPolygon& polygon, std::span<const SizeSample> samples);
  Cell cell(PlanePoint p) const;
  void bend(std::span<const SizeSample> samples);
  void limit_by(std::span<const SizeSample> samples, double grading);
  void grade(double grading);

  PlanePoint origin_;
  double spacing_m_ = 0.0;
  std::size_t columns_ = 0, rows_ = 0;
  double uniform_m_ = 0.0;
  std::vector<double> size_m_;  ///< [row][column]; none where uniform
};

}  // namespace tenku
