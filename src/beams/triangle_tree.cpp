#include "beams/triangle_tree.h"

#include <algorithm>
#include <numeric>

namespace tenku {
namespace {

constexpr std::uint32_t kLeaf = 4;

bool reaches(const Extent& box, const HalfSpace& space) {
  const Vec3 furthest{space.normal.x > 0.0 ? box.max.x : box.min.x,
                      space.normal.y > 0.0 ? box.max.y : box.min.y,
                      space.normal.z > 0.0 ? box.max.z : box.min.z};
  return dot(space.normal, furthest) + space.offset >= 0.0;
}

double along(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

int longest_axis(Vec3 size) {
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

}  // namespace

TriangleTree::TriangleTree(const TriangleSoup& soup) : soup_(soup), order_(soup.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  std::vector<Vec3> middle;
  middle.reserve(soup.size());
  for (const auto& [a, b, c] : soup.triangles) {
    middle.push_back((1.0 / 3.0) * (soup.vertices[a] + soup.vertices[b] + soup.vertices[c]));
  }
  nodes_.reserve(soup.size());
  if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()), middle);
}

std::uint32_t TriangleTree::build(std::uint32_t first, std::uint32_t last,
                                  const std::vector<Vec3>& middle) {
  const auto self = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Extent box, middles;
  for (std::uint32_t k = first; k < last; ++k) {
    for (const std::uint32_t v : soup_.triangles[order_[k]]) box.add(soup_.vertices[v]);
    middles.add(middle[order_[k]]);
  }
  nodes_[self].box = box;
  if (last - first <= kLeaf) {
    nodes_[self].first = first;
    nodes_[self].count = last - first;
    return self;
  }
  const int axis = longest_axis(middles.size());
  const std::uint32_t half = first + (last - first) / 2;
  const auto at = [&](std::uint32_t k) { return order_.begin() + k; };
  std::nth_element(at(first), at(half), at(last), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(along(middle[a], axis), a) < std::pair(along(middle[b], axis), b);
  });
  build(first, half, middle);
  const std::uint32_t right = build(half, last, middle);
  nodes_[self].right = right;
  return self;
}

void TriangleTree::find(std::span<const HalfSpace> spaces,
                        std::vector<std::uint32_t>& found) const {
  if (nodes_.empty()) return;
  const auto is_outside = [&](std::uint32_t t, const HalfSpace& space) {
    return std::all_of(soup_.triangles[t].begin(), soup_.triangles[t].end(), [&](std::uint32_t v) {
      return dot(space.normal, soup_.vertices[v]) + space.offset < 0.0;
    });
  };
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    const Node& node = nodes_[at];
    if (!std::all_of(spaces.begin(), spaces.end(),
                     [&](const HalfSpace& s) { return reaches(node.box, s); })) {
      continue;
    }
    if (node.count == 0) {
      open.push_back(node.right);
      open.push_back(at + 1);
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      const std::uint32_t t = order_[k];
      if (std::none_of(spaces.begin(), spaces.end(),
                       [&](const HalfSpace& s) { return is_outside(t, s); })) {
        found.push_back(t);
      }
    }
  }
}

}  // namespace tenku
