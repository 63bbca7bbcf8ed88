#include "beams/face_tree.h"

#include <algorithm>
#include <numeric>

namespace tenku {
namespace {

constexpr std::uint32_t kLeaf = 4;  // boxes

double middle(const FaceBox& box, int axis) {
  const Vec3 sum = box.low + box.high;
  return axis == 0 ? sum.x : axis == 1 ? sum.y : sum.z;
}

int longest_axis(const FaceBox& box) {
  const Vec3 size = box.high - box.low;
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

}  // namespace

FaceBox FaceBox::around(std::span<const Vec3> points) {
  FaceBox box{points.front(), points.front()};
  for (const Vec3 p : points) box.add({p, p});
  return box;
}

void FaceBox::add(const FaceBox& other) {
  low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y), std::min(low.z, other.low.z)};
  high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y),
          std::max(high.z, other.high.z)};
}

bool FaceBox::is_behind(const Plane& plane) const {
  const Vec3 n = plane.normal;
  const Vec3 farthest{n.x > 0.0 ? high.x : low.x, n.y > 0.0 ? high.y : low.y,
                      n.z > 0.0 ? high.z : low.z};
  return plane.height(farthest) < 0.0;
}

FaceTree::FaceTree(std::vector<FaceBox> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
}

void FaceTree::build(std::uint32_t begin, std::uint32_t end) {
  FaceBox box = boxes_[order_[begin]];
  for (std::uint32_t k = begin; k < end; ++k) box.add(boxes_[order_[k]]);
  const std::size_t node = nodes_.size();
  nodes_.push_back({box, begin, end, 0});
  if (end - begin <= kLeaf) return;
  const int axis = longest_axis(box);
  const std::uint32_t half = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double at_a = middle(boxes_[a], axis), at_b = middle(boxes_[b], axis);
                     return at_a < at_b || (at_a == at_b && a < b);
                   });
  build(begin, half);
  nodes_[node].right = static_cast<std::uint32_t>(nodes_.size());
  build(half, end);
}

std::vector<std::uint32_t> FaceTree::before(std::span<const Plane> planes) const {
  std::vector<std::uint32_t> found, waiting;
  if (!nodes_.empty()) waiting.push_back(0);
  const auto is_out = [&](const FaceBox& box) {
    return std::any_of(planes.begin(), planes.end(),
                       [&](const Plane& plane) { return box.is_behind(plane); });
  };
  while (!waiting.empty()) {
    const std::uint32_t at = waiting.back();
    waiting.pop_back();
    const Node& node = nodes_[at];
    if (is_out(node.box)) continue;
    if (node.right != 0) {
      waiting.push_back(at + 1);
      waiting.push_back(node.right);
      continue;
    }
    for (std::uint32_t k = node.begin; k < node.end; ++k) {
      if (!is_out(boxes_[order_[k]])) found.push_back(order_[k]);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace tenku
