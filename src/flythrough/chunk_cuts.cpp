#include "flythrough/chunk_cuts.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tenku {
namespace {

using Part = std::vector<std::uint32_t>;

double along(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

int longest_axis(Vec3 size) {
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

void cut(const StoredPoints& points, Part part, std::size_t most, std::vector<Part>& done) {
  if (part.size() <= most) {
    done.push_back(std::move(part));
    return;
  }
  Extent box;
  for (const std::uint32_t i : part) box.add(points.position[i]);
  const int axis = longest_axis(box.size());
  const auto middle = part.begin() + static_cast<std::ptrdiff_t>(part.size() / 2);
  std::nth_element(part.begin(), middle, part.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double pa = along(points.position[a], axis), pb = along(points.position[b], axis);
    return pa != pb ? pa < pb : a < b;
  });
  Part low(part.begin(), middle), high(middle, part.end());
  cut(points, std::move(low), most, done);
  cut(points, std::move(high), most, done);
}

/// Every third bit, from 21 bits.
std::uint64_t spread(std::uint64_t v) {
  v &= 0x1fffffU;
  v = (v | v << 32U) & 0x1f00000000ffffU;
  v = (v | v << 16U) & 0x1f0000ff0000ffU;
  v = (v | v << 8U) & 0x100f00f00f00f00fU;
  v = (v | v << 4U) & 0x10c30c30c30c30c3U;
  return (v | v << 2U) & 0x1249249249249249U;
}

void sort_by_morton(const StoredPoints& points, Part& part) {
  Extent box;
  for (const std::uint32_t i : part) box.add(points.position[i]);
  const double side = std::max(box.longest_side(), 1e-9);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  for (const std::uint32_t i : part) {
    const Vec3 at = (2097151.0 / side) * (points.position[i] - box.min);
    order.emplace_back(spread(static_cast<std::uint64_t>(at.x)) |
                           spread(static_cast<std::uint64_t>(at.y)) << 1U |
                           spread(static_cast<std::uint64_t>(at.z)) << 2U,
                       i);
  }
  std::sort(order.begin(), order.end());
  for (std::size_t k = 0; k < part.size(); ++k) part[k] = order[k].second;
}

}  // namespace

std::vector<Part> cut_by_space(const StoredPoints& points, std::size_t most) {
  std::vector<Part> parts;
  if (points.empty()) return parts;
  Part all(points.size());
  std::iota(all.begin(), all.end(), 0U);
  cut(points, std::move(all), most, parts);
  for (Part& part : parts) sort_by_morton(points, part);
  return parts;
}

}  // namespace tenku
