#include "meshing/element_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "meshing/point_tree.h"

namespace tenku {
namespace {

constexpr std::uint32_t kLeaf = 8;

double coordinate(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

double distance_to_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 normal = cross(b - a, c - a);
  const auto is_left = [&](Vec3 from, Vec3 to) {
    return dot(cross(to - from, p - from), normal) >= 0.0;
  };
  if (is_left(a, b) && is_left(b, c) && is_left(c, a)) {
    return std::abs(dot(p - a, normal)) / length(normal);
  }
  return std::min(
      {distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

}  // namespace

ElementTree::ElementTree(const ElementMesh& mesh) : mesh_(mesh), order_(mesh.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
}

void ElementTree::build(std::uint32_t begin, std::uint32_t end) {
  const std::size_t node = nodes_.size();
  nodes_.push_back({{}, begin, end});
  Extent centres;
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const std::uint32_t v : mesh_.elements[order_[i]]) nodes_[node].box.add(mesh_.vertices[v]);
    centres.add(mesh_.centre(order_[i]));
  }
  if (end - begin <= kLeaf) return;
  const Vec3 size = centres.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t i, std::uint32_t j) {
                     const double p = coordinate(mesh_.centre(i), axis),
                                  q = coordinate(mesh_.centre(j), axis);
                     return p != q ? p < q : i < j;
                   });
  build(begin, middle);
  nodes_[node].second = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

double ElementTree::distance_m(Vec3 p, std::uint32_t element) const {
  const auto& [a, b, c] = mesh_.elements[element];
  return distance_to_triangle(p, mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]);
}

}  // namespace tenku
