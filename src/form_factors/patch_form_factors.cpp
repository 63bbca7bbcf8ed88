#include "form_factors/patch_form_factors.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "form_factors/exchange_area.h"
#include "form_factors/part_queue.h"

namespace tenku {
namespace {

ConvexPolygon polygon_of(const ElementMesh& mesh, std::uint32_t element) {
  const auto& [a, b, c] = mesh.elements[element];
  return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

/// The part of an element before a side's plane.
ConvexPolygon part_before(const ElementMesh& mesh, std::uint32_t element, std::uint32_t side) {
  const Vec3 normal = mesh.normal(side);
  const Vec3 at = mesh.vertices[mesh.elements[side / 2][0]];
  return cut(polygon_of(mesh, element), [&](Vec3 p) { return dot(p - at, normal); });
}

/// Form factor between sides of which nothing hides a part from the other.
double clear_form_factor(const ElementMesh& mesh, std::uint32_t from, std::uint32_t to) {
  return exchange_area(part_before(mesh, from / 2, to), part_before(mesh, to / 2, from)) /
         mesh.area_m2(from / 2);
}

/// Form factors to what a side sees unhindered; what it does not so see stays wanted.
SparseRow clear_row(const ElementMesh& mesh, const Sightlines& sightlines,
                    const std::vector<Column>& column, std::uint32_t from,
                    std::vector<char>& wanted) {
  SparseRow row;
  const auto before = [](std::uint8_t sides, std::uint32_t side) {
    return (sides & (side % 2 == 0 ? Sightlines::kFront : Sightlines::kBack)) != 0;
  };
  for (std::uint32_t to = 0; to < mesh.sides(); ++to) {
    if (!wanted[to]) continue;
    const bool facing = before(sightlines.sides(from / 2, to / 2), from) &&
                        before(sightlines.sides(to / 2, from / 2), to);
    if (facing && !sightlines.are_clear(from / 2, to / 2)) continue;
    if (facing) row.push_back({column[to], clear_form_factor(mesh, from, to)});
    wanted[to] = 0;
  }
  return sorted(std::move(row));
}

}  // namespace

PatchFormFactors::PatchFormFactors(const FormFactorMethod& method, const ElementMesh& mesh,
                                   std::vector<Column> column,
                                   const PatchFormFactorOptions& options)
    : method_(method),
      mesh_(mesh),
      column_(std::move(column)),
      options_(options),
      edges_(mesh, column_) {
  expects(column_.size() == mesh.sides(), "each side has a column");
  if (method.is_exact() && mesh.size() <= Sightlines::kMostElements) sightlines_.emplace(mesh);
}

std::vector<PatchFormFactor> PatchFormFactors::row(std::size_t patch, bool back) const {
  SparseRow value, error;
  const double patch_area = mesh_.patch_area_m2(patch);
  for (std::uint32_t e = mesh_.patch_begin[patch]; e < mesh_.patch_begin[patch + 1]; ++e) {
    const std::uint32_t side = 2 * e + (back ? 1 : 0);
    const double share = mesh_.area_m2(e) / patch_area;
    std::vector<char> wanted(mesh_.sides());
    for (std::size_t s = 0; s < wanted.size(); ++s) wanted[s] = column_[s] != kNoColumn ? 1 : 0;
    if (sightlines_) {
      value = combined(value, 1.0, clear_row(mesh_, *sightlines_, column_, side, wanted), share);
    }
    if (std::find(wanted.begin(), wanted.end(), 1) == wanted.end()) continue;
    PartQueue parts({method_, mesh_, options_, column_, edges_}, wanted, side);
    parts.refine();
    value = combined(value, 1.0, parts.row(), share);
    error = combined(error, 1.0, parts.error(), share);
  }
  std::vector<PatchFormFactor> row;
  for (const auto& [column, sum] : combined(value, 1.0, error, 0.0))
    row.push_back({column, sum, 0});
  auto to = row.begin();
  for (const auto& [column, sum] : error) {
    while (to->column != column) ++to;
    to->error = sum;
  }
  return row;
}

}  // namespace tenku
