/// Where what each patch sends arrives: rows of form factors, found when they are first asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "form_factors/form_factor.h"
#include "form_factors/form_factor_store.h"
#include "form_factors/outward_view.h"
#include "meshing/element_mesh.h"

namespace tenku {

/// What rows are found from, and where they are kept.
struct PatchRowOptions {
  double lift_m = 1e-5;                            ///< of points off their surface
  std::size_t most_bytes = std::size_t{1} << 30U;  ///< of the rows kept
};

/// Rows of patch sides: the mean over the patch of the form factors of up to kMostPoints points,
/// the middles of elements spread over it, by their areas.
///
/// Rows that the memory does not hold are found again each time.
class PatchRows {
 public:
  static constexpr std::size_t kMostPoints = 4;

  /// @param mesh, method  kept by reference
  PatchRows(const ElementMesh& mesh, const FormFactorMethod& method, PatchRowOptions options);

  /// Rows of these patch sides; good until the next call.
  /// Same bits for any number of threads.
  /// @throws Cancelled
  std::vector<const FormFactorRow*> rows_of(std::span<const std::uint32_t> patch_sides,
                                            const Progress& progress);

  /// Rows that had to be found, in all, also those found again.
  std::size_t found() const { return found_; }
  /// How often a row was found that the memory does not hold.
  std::size_t refused() const { return found_ - store_.kept(); }
  double seconds() const { return seconds_; }  ///< that it took
  const FormFactorStore& store() const { return store_; }

 private:
  FormFactorRow find(std::uint32_t patch_side) const;

  const ElementMesh& mesh_;
  const FormFactorMethod& method_;
  PatchRowOptions options_;
  OutwardView outward_;
  FormFactorStore store_;
  std::vector<FormFactorRow> passing_;  ///< of the last call, those that are not kept
  std::size_t found_ = 0;
  double seconds_ = 0.0;
};

}  // namespace tenku
