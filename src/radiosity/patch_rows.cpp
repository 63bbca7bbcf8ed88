#include "radiosity/patch_rows.h"

#include <algorithm>
#include <utility>

#include "core/parallel.h"
#include "core/stopwatch.h"

namespace tenku {
namespace {

/// Sum of weighted rows, sides in rising order.
FormFactorRow mean_of(std::vector<std::pair<double, FormFactorRow>> parts) {
  if (parts.size() == 1) return std::move(parts.front().second);
  FormFactorRow all;
  for (const auto& [weight, row] : parts) {
    for (const FormFactor& f : row) {
      all.push_back({f.side, static_cast<float>(weight * f.value)});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const FormFactor& a, const FormFactor& b) { return a.side < b.side; });
  FormFactorRow mean;
  for (const FormFactor& f : all) {
    if (!mean.empty() && mean.back().side == f.side) {
      mean.back().value += f.value;
    } else {
      mean.push_back(f);
    }
  }
  return mean;
}

}  // namespace

PatchRows::PatchRows(const ElementMesh& mesh, const FormFactorMethod& method,
                     PatchRowOptions options)
    : mesh_(mesh),
      method_(method),
      options_(options),
      store_(2 * mesh.patches(), options.most_bytes) {
  for (const auto& corners : mesh.elements) {
    for (const std::uint32_t v : corners) extent_.add(mesh.vertices[v]);
  }
}

std::vector<const FormFactorRow*> PatchRows::rows_of(std::span<const std::uint32_t> patch_sides,
                                                     const Progress& progress) {
  std::vector<std::uint32_t> missing;
  for (const std::uint32_t side : patch_sides) {
    if (store_.find(side) == nullptr) missing.push_back(side);
  }
  const Stopwatch watch;
  std::vector<FormFactorRow> fresh(missing.size());
  parallel_for(missing.size(), 1, [&](IndexRange range) {
    for (std::size_t k = range.begin; k < range.end; ++k) {
      progress.stop_if_cancelled();
      fresh[k] = find(missing[k]);
    }
  });
  found_ += missing.size();
  seconds_ += watch.seconds();
  passing_.clear();
  passing_.reserve(missing.size());  // pointers into it stay good
  std::vector<const FormFactorRow*> rows;
  std::size_t next = 0;
  for (const std::uint32_t side : patch_sides) {
    if (store_.find(side) == nullptr) {
      FormFactorRow& row = fresh[next++];
      if (!store_.fits(row)) {
        passing_.push_back(std::move(row));
        rows.push_back(&passing_.back());
        continue;
      }
      store_.keep(side, std::move(row));
    }
    rows.push_back(store_.find(side));
  }
  return rows;
}

bool PatchRows::faces_nothing(std::uint32_t patch_side) const {
  const std::size_t element = mesh_.patch_begin[patch_side / 2];
  const Vec3 normal = mesh_.normal(2 * element + patch_side % 2);
  const Vec3 farthest{normal.x > 0.0 ? extent_.max.x : extent_.min.x,
                      normal.y > 0.0 ? extent_.max.y : extent_.min.y,
                      normal.z > 0.0 ? extent_.max.z : extent_.min.z};
  return !(dot(normal, farthest - mesh_.centre(element)) > options_.lift_m);
}

FormFactorRow PatchRows::find(std::uint32_t patch_side) const {
  if (faces_nothing(patch_side)) return {};
  const std::size_t patch = patch_side / 2;
  const double area = mesh_.patch_area_m2(patch);
  std::vector<std::pair<double, FormFactorRow>> parts;
  for (std::size_t e = mesh_.patch_begin[patch]; e < mesh_.patch_begin[patch + 1]; ++e) {
    const Vec3 normal = mesh_.normal(2 * e + patch_side % 2);
    parts.emplace_back(mesh_.area_m2(e) / area,
                       method_.from_point(mesh_.centre(e) + options_.lift_m * normal, normal));
  }
  return mean_of(std::move(parts));
}

}  // namespace tenku
