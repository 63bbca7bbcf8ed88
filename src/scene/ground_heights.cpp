#include "scene/ground_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tenku {
namespace {

constexpr double kMostCells = 4e6;
constexpr double kOutside = -1e-9;  // of a triangle, so that none falls between two

std::size_t index_in(double from, double to, std::size_t count, double value) {
  const double share = to > from ? (value - from) / (to - from) : 0.0;
  const double cell = std::floor(share * static_cast<double>(count));
  return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(count - 1)));
}

}  // namespace

GroundHeights::GroundHeights(const RawScene& raw, const Extent& within)
    : vertices_(raw.scene.vertices), box_(within) {
  const Surfaces& surfaces = raw.scene.surfaces;
  const auto span_of = [&](const std::array<std::uint32_t, 3>& t) {
    Extent span;
    for (const std::uint32_t v : t) span.add(vertices_[v]);
    return span;
  };
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    if (surfaces.type[s] != SurfaceType::Ground || raw.is_building[surfaces.object[s]]) continue;
    const auto ring = surfaces.outer_ring(s);
    if (ring.size() != 3 || surfaces.rings(s) != 1) continue;
    const std::array<std::uint32_t, 3> t{ring[0], ring[1], ring[2]};
    const Extent span = span_of(t);
    const bool is_beside = span.max.x < box_.min.x || span.min.x > box_.max.x ||
                           span.max.y < box_.min.y || span.min.y > box_.max.y;
    if (!is_beside) triangles_.push_back(t);
  }
  const double width = box_.max.x - box_.min.x, depth = box_.max.y - box_.min.y;
  const double cells = std::clamp(static_cast<double>(triangles_.size()), 1.0, kMostCells);
  const double cell = std::sqrt(std::max(width * depth / cells, 1e-6));
  columns_ = static_cast<std::size_t>(std::clamp(std::ceil(width / cell), 1.0, cells));
  rows_ = static_cast<std::size_t>(std::clamp(std::ceil(depth / cell), 1.0, cells));
  const auto for_each_cell = [&](const std::array<std::uint32_t, 3>& t, const auto& visit) {
    const Extent span = span_of(t);
    for (std::size_t r = row(span.min.y); r <= row(span.max.y); ++r) {
      for (std::size_t c = column(span.min.x); c <= column(span.max.x); ++c) {
        visit(r * columns_ + c);
      }
    }
  };
  first_.assign(columns_ * rows_ + 1, 0);
  for (const auto& t : triangles_) for_each_cell(t, [&](std::size_t k) { ++first_[k + 1]; });
  for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  listed_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    for_each_cell(triangles_[i], [&](std::size_t k) { listed_[next[k]++] = i; });
  }
}

std::size_t GroundHeights::column(double x) const {
  return index_in(box_.min.x, box_.max.x, columns_, x);
}

std::size_t GroundHeights::row(double y) const {
  return index_in(box_.min.y, box_.max.y, rows_, y);
}

std::optional<double> GroundHeights::at(double x, double y) const {
  const std::size_t cell = row(y) * columns_ + column(x);
  std::optional<double> highest;
  for (std::uint32_t k = first_[cell]; k < first_[cell + 1]; ++k) {
    const auto& t = triangles_[listed_[k]];
    const Vec3 a = vertices_[t[0]], u = vertices_[t[1]] - a, v = vertices_[t[2]] - a;
    const double area = u.x * v.y - u.y * v.x, px = x - a.x, py = y - a.y;
    const double s = (px * v.y - py * v.x) / area, r = (u.x * py - u.y * px) / area;
    if (!(s >= kOutside && r >= kOutside && s + r <= 1.0 - kOutside)) continue;
    const double z = a.z + s * u.z + r * v.z;
    if (!highest || z > *highest) highest = z;
  }
  return highest;
}

}  // namespace tenku
