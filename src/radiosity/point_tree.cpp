#include "radiosity/point_tree.h"

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
  std::array<Span, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, order_.size(), from, to};
  while (depth > 0) {
    const auto [begin, end, a, b] = stack[--depth];
    if (end - begin <= kLeaf) {
      for (std::size_t i = begin; i < end; ++i) {
        if (distance_to_segment(points_[order_[i]], from, to) <= reach_m) {
          found.push_back(order_[i]);
        }
      }
      continue;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const auto [cut, axis] = cuts_[middle];
    const double p = on_axis(a, axis) - cut, q = on_axis(b, axis) - cut;
    // The part of the segment within reach of each half, with as much again for rounding.
    const auto part = [&](double side) {
      Span half{begin, end, a, b};
      const double sp = side * p - 2.0 * reach_m, sq = side * q - 2.0 * reach_m;
      if (sp > 0.0 && sq <= 0.0) half.a = between(a, b, sp / (sp - sq));
      if (sq > 0.0 && sp <= 0.0) half.b = between(a, b, sp / (sp - sq));
      return half;
    };
    if (std::min(p, q) <= 2.0 * reach_m) {
      stack[depth] = part(1.0);
      stack[depth++].end = middle;
    }
    if (std::max(p, q) >= -2.0 * reach_m) {
      stack[depth] = part(-1.0);
      stack[depth++].begin = middle;
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::uint32_t> welded(std::span<const Vec3> points, double reach_m) {
  // A point has at most eight cells of this size within its reach.
  const double cell = 4.0 * reach_m;
  std::unordered_multimap<std::uint64_t, std::uint32_t> kept;
  kept.reserve(points.size());
  const auto key = [](Vec3 c) {
    const auto whole = [](double x) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(x));
    };
    return mix_bits(whole(c.x) + mix_bits(whole(c.y) + mix_bits(whole(c.z))));
  };
  const auto cell_of = [&](double x) { return std::floor(x / cell); };
  std::vector<std::uint32_t> first(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Vec3 p = points[i];
    const auto lowest_near = [&] {
      std::uint32_t lowest = i;
      for (double x = cell_of(p.x - reach_m); x <= cell_of(p.x + reach_m); ++x) {
        for (double y = cell_of(p.y - reach_m); y <= cell_of(p.y + reach_m); ++y) {
          for (double z = cell_of(p.z - reach_m); z <= cell_of(p.z + reach_m); ++z) {
            const auto [begin, end] = kept.equal_range(key({x, y, z}));
            for (auto k = begin; k != end; ++k) {
              if (length(points[k->second] - p) <= reach_m) lowest = std::min(lowest, k->second);
            }
          }
        }
      }
      return lowest;
    };
    first[i] = lowest_near();
    if (first[i] == i) kept.emplace(key({cell_of(p.x), cell_of(p.y), cell_of(p.z)}), i);
  }
  return first;
}

}  // namespace tenku
