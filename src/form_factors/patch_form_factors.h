/// Form factors from surfaces, not points: rows of patches.
#pragma once

#include <optional>
#include <vector>

#include "core/progress.h"
#include "form_factors/form_factor.h"
#include "form_factors/sightlines.h"
#include "form_factors/target_edges.h"

namespace tenku {

/// Of all that one side of a patch sends, what reaches the sides of a column first.
struct PatchFormFactor {
  Column column;
  double value;
  double error;  ///< estimate, of the integration over the patch
};

struct PatchFormFactorOptions {
  /// Parts of a patch are smaller than the distance to the edges of what they see, divided by this:
  /// the five-times rule.
  double distance_ratio = 5.0;
  double relative_tolerance = 1e-3;    ///< of each form factor, 0 for none
  double absolute_tolerance = 1e-5;    ///< what is smaller does not matter
  std::size_t most_points = 1000;      ///< of each element of the patch
  const Progress* progress = nullptr;  ///< asked now and then whether to stop; borrowed
};

/// Rows of patches by any method.
///
/// A row is the mean of rows from points on the patch. Each third of an element of it is a part
/// with four points; parts are cut in two, those first that leave most in doubt, until each form
/// factor is within its tolerance or the points are used up. In doubt is by how much the rows of
/// two halves differ from that of the whole, and, where the five-times rule is broken, what might
/// have been missed near an edge. Parts are cut across the way to the edge that is too near, so
/// that a few narrow strips do along a touching edge.
///
/// With a method that is exact at points, pairs of elements between which nothing stands are taken
/// out and integrated exactly (`exchange_area`), in meshes small enough for `Sightlines`.
///
/// Source  the rule: D. R. Baum, H. E. Rushmeier and J. M. Winget, "Improving radiosity solutions
///         through the use of analytically determined form-factors", SIGGRAPH 1989.
/// Threads  immutable after construction; may be shared.
class PatchFormFactors {
 public:
  /// @param method, mesh  kept by reference
  /// @param column        [side]: which sides are taken together, by number from 0, or `kNoColumn`
  PatchFormFactors(const FormFactorMethod& method, const ElementMesh& mesh,
                   std::vector<Column> column, const PatchFormFactorOptions& options);

  /// Row of a side of a patch, in rising order of column.
  /// @throws Cancelled if the user asked to stop
  std::vector<PatchFormFactor> row(std::size_t patch, bool back) const;

 private:
  const FormFactorMethod& method_;
  const ElementMesh& mesh_;
  std::vector<Column> column_;
  PatchFormFactorOptions options_;
  TargetEdges edges_;
  std::optional<Sightlines> sightlines_;
};

}  // namespace tenku
