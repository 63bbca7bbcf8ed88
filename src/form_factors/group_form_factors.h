/// Form factors between named parts of a scene.
#pragma once

#include <cstddef>
#include <vector>

#include "core/progress.h"
#include "form_factors/patch_form_factors.h"

namespace tenku {

struct GroupFormFactorOptions {
  bool two_sided = false;  ///< every face sees and is seen from both sides; else only its front
  PatchFormFactorOptions patch;
};

/// The matrix of form factors between groups of elements.
///
/// A form factor is the fraction of what all faces of `from` send that reaches one of `to` first:
/// with two sides, what both sides of a face send is counted in parts of what one sends, so that a
/// face of which only one side sees anything has the same form factors either way, whichever side
/// that is.
///
/// Shape  [from][to], row-major.
struct GroupFormFactors {
  std::size_t groups = 0;
  std::vector<double> area_m2;       ///< [group], of one side
  std::vector<double> value, error;  ///< the error is an estimate
  /// [group], what of a row's 1 meets backs of faces first; none with two sides.
  std::vector<double> to_backs;
  bool within_tolerance = true;  ///< all errors

  double row_sum(std::size_t from) const;
  /// Greatest difference over all pairs between what one sends to the other and what that sends
  /// back, in parts of what the smaller one sends.
  double reciprocity_defect() const;
};

/// @param mesh    each element a patch of its own; its `object` is the number of its group
/// @param groups  their number
/// @throws Cancelled if the user asked to stop
GroupFormFactors group_form_factors(const FormFactorMethod& method, const ElementMesh& mesh,
                                    std::size_t groups, const GroupFormFactorOptions& options,
                                    Progress& progress);

}  // namespace tenku
