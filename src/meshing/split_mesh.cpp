#include "meshing/split_mesh.h"

#include <algorithm>

#include "core/error.h"

namespace tenku {

SplitMesh::SplitMesh(const PolygonMesh& mesh) : triangle_(mesh.elements) {
  shown_.vertices = mesh.vertices;
  show();
}

std::uint32_t SplitMesh::middle(std::uint32_t a, std::uint32_t b) {
  const auto next = static_cast<std::uint32_t>(shown_.vertices.size());
  const auto [found, is_new] = middle_.emplace(std::minmax(a, b), next);
  if (is_new) shown_.vertices.push_back(0.5 * (shown_.vertices[a] + shown_.vertices[b]));
  return found->second;
}

std::uint32_t SplitMesh::middle_if_any(std::uint32_t a, std::uint32_t b) const {
  const auto found = middle_.find(std::minmax(a, b));
  return found == middle_.end() ? kNowhere : found->second;
}

bool SplitMesh::must_split(const Triangle& t) const {
  int finer = 0;
  for (unsigned k = 0; k < 3; ++k) {
    const std::uint32_t a = t[k], b = t[(k + 1) % 3], m = middle_if_any(a, b);
    if (m == kNowhere) continue;
    if (middle_if_any(a, m) != kNowhere || middle_if_any(m, b) != kNowhere) return true;
    ++finer;
  }
  return finer == 3;
}

void SplitMesh::split_in_four(std::size_t triangle) {
  const auto [a, b, c] = triangle_[triangle];
  const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
  triangle_[triangle] = {ab, bc, ca};
  triangle_.push_back({a, ab, ca});
  triangle_.push_back({b, bc, ab});
  triangle_.push_back({c, ca, bc});
}

void SplitMesh::split(std::span<const std::uint8_t> is_wanted) {
  expects(is_wanted.size() == triangle_of_.size(), "one mark for each element shown");
  std::vector<std::uint8_t> now(triangle_.size());
  for (std::size_t e = 0; e < is_wanted.size(); ++e) now[triangle_of_[e]] |= is_wanted[e];
  const std::size_t before = triangle_.size();
  for (std::size_t t = 0; t < before; ++t) {
    if (now[t] != 0) split_in_four(t);
  }
  for (bool again = true; again;) {
    again = false;
    for (std::size_t t = 0; t < triangle_.size(); ++t) {
      if (!must_split(triangle_[t])) continue;
      split_in_four(t);
      again = true;
    }
  }
  show();
}

void SplitMesh::show() {
  shown_.elements.clear();
  triangle_of_.clear();
  for (std::uint32_t t = 0; t < triangle_.size(); ++t) {
    show(triangle_[t]);
    triangle_of_.resize(shown_.elements.size(), t);
  }
}

void SplitMesh::show(const Triangle& t) {
  std::array<std::uint32_t, 3> m{};
  for (unsigned k = 0; k < 3; ++k) m[k] = middle_if_any(t[k], t[(k + 1) % 3]);
  const auto finer = std::count_if(m.begin(), m.end(), [](auto v) { return v != kNowhere; });
  auto& shown = shown_.elements;
  if (finer == 0) {
    shown.push_back(t);
    return;
  }
  // Turned so that the only split edge, or the only whole one, comes first.
  const bool is_one = finer == 1;
  unsigned k = 0;
  while ((m[k] != kNowhere) != is_one) ++k;
  const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
  if (is_one) {
    shown.push_back({a, m[k], c});
    shown.push_back({m[k], b, c});
    return;
  }
  const std::uint32_t bc = m[(k + 1) % 3], ca = m[(k + 2) % 3];
  shown.push_back({bc, c, ca});
  shown.push_back({a, b, bc});
  shown.push_back({a, bc, ca});
}

}  // namespace tenku
