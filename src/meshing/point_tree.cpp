#include "meshing/point_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "core/extent.h"
#include "core/random.h"

namespace tenku {
namespace {

constexpr std::size_t kLeaf = 8;

double on_axis(Vec3 p, std::uint8_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// Part of a segment that is still asked for.
struct Span {
  std::size_t begin, end;
  Vec3 a, b;
};

Vec3 between(Vec3 a, Vec3 b, double t) { return a + t * (b - a); }

/// The points that stand for others, by cells of space.
class WeldTable {
 public:
  WeldTable(std::span<const Vec3> points, double reach_m)
      : points_(points), reach_m_(reach_m), cell_(4.0 * reach_m) {
    kept_.reserve(points.size());
  }

  void keep(std::uint32_t i) { kept_.emplace(key(cell_of(points_[i])), i); }

  /// The lowest of those kept in reach of point `i`, or `i`.
  std::uint32_t first_near(std::uint32_t i) const {
    const Vec3 p = points_[i], reach{reach_m_, reach_m_, reach_m_};
    const Vec3 low = cell_of(p - reach), high = cell_of(p + reach);
    std::uint32_t first = i;
    for (double x = low.x; x <= high.x; ++x) {
      for (double y = low.y; y <= high.y; ++y) {
        for (double z = low.z; z <= high.z; ++z) {
          const auto [begin, end] = kept_.equal_range(key({x, y, z}));
          for (auto k = begin; k != end; ++k) {
            if (length(points_[k->second] - p) <= reach_m_) first = std::min(first, k->second);
          }
        }
      }
    }
    return first;
  }

 private:
  Vec3 cell_of(Vec3 p) const {
    return {std::floor(p.x / cell_), std::floor(p.y / cell_), std::floor(p.z / cell_)};
  }
  static std::uint64_t key(Vec3 cell) {
    const auto whole = [](double x) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(x));
    };
    return mix_bits(whole(cell.x) + mix_bits(whole(cell.y) + mix_bits(whole(cell.z))));
  }

  std::span<const Vec3> points_;
  double reach_m_, cell_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> kept_;
};

/// The part of a segment that is not above a plane, given the heights of its ends.
Span below(Span span, double height_a, double height_b) {
  const Vec3 cut = between(span.a, span.b, height_a / (height_a - height_b));
  if (height_a > 0.0 && height_b <= 0.0) span.a = cut;
  if (height_b > 0.0 && height_a <= 0.0) span.b = cut;
  return span;
}

}  // namespace

double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 d = b - a;
  const double whole = dot(d, d);
  const double t = whole > 0.0 ? std::clamp(dot(p - a, d) / whole, 0.0, 1.0) : 0.0;
  return length(p - between(a, b, t));
}

PointTree::PointTree(std::span<const Vec3> points)
    : points_(points), order_(points.size()), cuts_(points.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  build(0, order_.size());
}

void PointTree::build(std::size_t begin, std::size_t end) {
  if (end - begin <= kLeaf) return;
  Extent box;
  for (std::size_t i = begin; i < end; ++i) box.add(points_[order_[i]]);
  const Vec3 size = box.size();
  const std::uint8_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t i, std::uint32_t j) {
    const double p = on_axis(points_[i], axis), q = on_axis(points_[j], axis);
    return p != q ? p < q : i < j;
  });
  cuts_[middle] = {on_axis(points_[order_[middle]], axis), axis};
  build(begin, middle);
  build(middle, end);
}

std::vector<std::uint32_t> PointTree::near_segment(Vec3 from, Vec3 to, double reach_m) const {
  std::vector<std::uint32_t> found;
  std::array<Span, 64> stack;  // a tree of 2^64 points is no deeper
  std::size_t depth = 0;
  stack[depth++] = {0, order_.size(), from, to};
  while (depth > 0) {
    const Span span = stack[--depth];
    if (span.end - span.begin <= kLeaf) {
      for (std::size_t i = span.begin; i < span.end; ++i) {
        const std::uint32_t point = order_[i];
        if (distance_to_segment(points_[point], from, to) <= reach_m) found.push_back(point);
      }
      continue;
    }
    const std::size_t middle = span.begin + (span.end - span.begin) / 2;
    const auto [cut, axis] = cuts_[middle];
    // As much again as the reach, for rounding.
    const double p = on_axis(span.a, axis) - cut, q = on_axis(span.b, axis) - cut;
    if (std::min(p, q) <= 2.0 * reach_m) {
      stack[depth] = below(span, p - 2.0 * reach_m, q - 2.0 * reach_m);
      stack[depth++].end = middle;
    }
    if (std::max(p, q) >= -2.0 * reach_m) {
      stack[depth] = below(span, -p - 2.0 * reach_m, -q - 2.0 * reach_m);
      stack[depth++].begin = middle;
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::uint32_t> welded(std::span<const Vec3> points, double reach_m) {
  WeldTable table(points, reach_m);
  std::vector<std::uint32_t> first(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    first[i] = table.first_near(i);
    if (first[i] == i) table.keep(i);
  }
  return first;
}

}  // namespace tenku
