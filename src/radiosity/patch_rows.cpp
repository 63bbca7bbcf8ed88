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
      outward_(mesh, options.lift_m),
      store_(2 * mesh.patches(), options.most_bytes) {}

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

FormFactorRow PatchRows::find(std::uint32_t patch_side) const {
  const std::size_t first = mesh_.patch_begin[patch_side / 2],
                    end = mesh_.patch_begin[patch_side / 2 + 1], count = end - first;
  const std::size_t points = std::min(count, kMostPoints);
  std::vector<std::pair<double, FormFactorRow>> parts;
  double area = 0.0;
  for (std::size_t k = 0; k < points; ++k) {
    const std::size_t e = first + (2 * k + 1) * count / (2 * points);  // spread over the patch
    const Vec3 normal = mesh_.normal(2 * e + patch_side % 2), at = mesh_.centre(e);
    if (k == 0 && outward_.faces_nothing(at, normal)) return {};
    area += mesh_.area_m2(e);
    parts.emplace_back(mesh_.area_m2(e), method_.from_point(at + options_.lift_m * normal, normal));
  }
  for (auto& [weight, row] : parts) weight /= area;
  return mean_of(std::move(parts));
}

}  // namespace tenku
