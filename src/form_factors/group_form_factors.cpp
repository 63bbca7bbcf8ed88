#include "form_factors/group_form_factors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"

namespace tenku {
namespace {

/// Those of backs that do not count, of all groups together, come last.
std::vector<Column> columns_of(const ElementMesh& mesh, std::size_t groups, bool two_sided) {
  std::vector<Column> column(mesh.sides(), static_cast<Column>(groups));
  for (std::size_t side = 0; side < column.size(); ++side) {
    if (two_sided || side % 2 == 0) column[side] = mesh.object[side / 2];
  }
  return column;
}

}  // namespace

double GroupFormFactors::row_sum(std::size_t from) const {
  const auto row = value.begin() + static_cast<std::ptrdiff_t>(from * groups);
  return std::accumulate(row, row + static_cast<std::ptrdiff_t>(groups), 0.0);
}

double GroupFormFactors::reciprocity_defect() const {
  double greatest = 0.0;
  for (std::size_t i = 0; i < groups; ++i) {
    for (std::size_t j = i + 1; j < groups; ++j) {
      const double sent = area_m2[i] * value[i * groups + j];
      const double back = area_m2[j] * value[j * groups + i];
      greatest = std::max(greatest, std::abs(sent - back) / std::min(area_m2[i], area_m2[j]));
    }
  }
  return greatest;
}

GroupFormFactors group_form_factors(const FormFactorMethod& method, const ElementMesh& mesh,
                                    std::size_t groups, const GroupFormFactorOptions& options,
                                    Progress& progress) {
  expects(mesh.patches() == mesh.size(), "each element is a patch of its own");
  PatchFormFactorOptions how = options.patch;
  how.progress = &progress;
  const PatchFormFactors patches(method, mesh, columns_of(mesh, groups, options.two_sided), how);
  std::vector<std::vector<PatchFormFactor>> rows(mesh.sides());
  progress.begin("form factors", mesh.size());
  parallel_for(mesh.size(), 1, [&](IndexRange range) {
    for (std::size_t e = range.begin; e < range.end; ++e) {
      progress.stop_if_cancelled();
      rows[2 * e] = patches.row(e, false);
      if (options.two_sided) rows[2 * e + 1] = patches.row(e, true);
      progress.advance(1);
    }
  });
  GroupFormFactors matrix{.groups = groups,
                          .area_m2 = std::vector<double>(groups),
                          .value = std::vector<double>(groups * groups),
                          .error = std::vector<double>(groups * groups),
                          .to_backs = std::vector<double>(groups)};
  for (std::size_t e = 0; e < mesh.size(); ++e) matrix.area_m2[mesh.object[e]] += mesh.area_m2(e);
  for (std::size_t side = 0; side < rows.size(); ++side) {
    const std::size_t from = mesh.object[side / 2];
    const double share = mesh.area_m2(side / 2) / matrix.area_m2[from];
    for (const auto& [to, value, error] : rows[side]) {
      if (to == groups) {
        matrix.to_backs[from] += share * value;
        continue;
      }
      matrix.value[from * groups + to] += share * value;
      matrix.error[from * groups + to] += share * error;
    }
  }
  for (std::size_t k = 0; k < matrix.value.size(); ++k) {
    const double tolerance =
        std::max(how.absolute_tolerance, how.relative_tolerance * matrix.value[k]);
    if (matrix.error[k] > tolerance) matrix.within_tolerance = false;
  }
  progress.end("");
  return matrix;
}

}  // namespace tenku
