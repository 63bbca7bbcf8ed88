#include "meshing/patch_groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

namespace tenku {
namespace {

/// Box in the plane.
struct Box {
  double x0 = std::numeric_limits<double>::infinity(), x1 = -x0, y0 = x0, y1 = -x0;

  void add(PlanePoint p) {
    x0 = std::min(x0, p.x), x1 = std::max(x1, p.x);
    y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
  }
  void add(const Box& b) {
    add(PlanePoint{b.x0, b.y0});
    add(PlanePoint{b.x1, b.y1});
  }
  double diagonal() const { return std::hypot(x1 - x0, y1 - y0); }
  PlanePoint middle() const { return {(x0 + x1) / 2, (y0 + y1) / 2}; }
};

/// An element, or the two of a rectangle, which stay together.
struct Cell {
  std::size_t first;  ///< element
  Box box;
};

class Grouping {
 public:
  Grouping(const PolygonMesh& mesh, std::vector<Cell> cells, double patch_m)
      : mesh_(mesh), cells_(std::move(cells)), patch_m_(patch_m) {}

  void divide(std::size_t begin, std::size_t end) {
    const std::span part(cells_.data() + begin, end - begin);
    Box box;
    for (const Cell& c : part) box.add(c.box);
    constexpr double kRounding = 1.0 + 1e-9;
    if (part.size() == 1 || box.diagonal() <= kRounding * patch_m_) return end_patches(begin, end);
    const double width = box.x1 - box.x0, height = box.y1 - box.y0;
    const bool is_wide = width >= height;
    const double from = is_wide ? box.x0 : box.y0, long_side = is_wide ? width : height;
    // So many squares of this diagonal stand along the longer side; the cut is between two of them.
    const double squares =
        std::max(2.0, std::ceil(std::numbers::sqrt2 * long_side / patch_m_ - 1e-9));
    const double cut = from + std::floor(squares / 2.0) / squares * long_side;
    // Cells halfway go to the first part, whatever the rounding.
    const double slack = 1e-9 * long_side;
    const auto is_first = [&](const Cell& c) {
      const PlanePoint middle = c.box.middle();
      return (is_wide ? middle.x : middle.y) <= cut + slack;
    };
    const auto middle = std::stable_partition(part.begin(), part.end(), is_first);
    auto first = static_cast<std::size_t>(middle - part.begin());
    // Cells of which none lies wholly to one side are parted by number.
    if (first == 0 || first == part.size()) first = part.size() / 2;
    divide(begin, begin + first);
    divide(begin + first, end);
  }

  const std::vector<Cell>& cells() const { return cells_; }
  const std::vector<std::size_t>& cells_in_patch() const { return cells_in_patch_; }

 private:
  /// Ends a patch for each set of cells that hang together.
  void end_patches(std::size_t begin, std::size_t end) {
    const std::span part(cells_.data() + begin, end - begin);
    const std::vector<std::size_t> root = components(part);
    std::vector<Cell> sorted;
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (root[i] != i) continue;
      std::size_t count = 0;
      for (std::size_t j = i; j < part.size(); ++j) {
        if (root[j] != i) continue;
        sorted.push_back(part[j]);
        ++count;
      }
      cells_in_patch_.push_back(count);
    }
    std::copy(sorted.begin(), sorted.end(), part.begin());
  }

  /// The first cell of those that each hangs together with.
  std::vector<std::size_t> components(std::span<const Cell> part) {
    std::vector<std::size_t> root(part.size());
    std::iota(root.begin(), root.end(), std::size_t{0});
    const auto find = [&](std::size_t i) {
      while (root[i] != i) i = root[i] = root[root[i]];
      return i;
    };
    std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::size_t>> edges;
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (std::size_t e = 0; e < mesh_.per_cell; ++e) {
        const auto& corner = mesh_.elements[part[i].first + e];
        for (unsigned k = 0; k < 3; ++k) {
          const auto [a, b] = std::minmax(corner[k], corner[(k + 1) % 3]);
          edges.push_back({{a, b}, i});
        }
      }
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
      if (edges[k].first != edges[k + 1].first) continue;
      const std::size_t a = find(edges[k].second), b = find(edges[k + 1].second);
      root[std::max(a, b)] = std::min(a, b);
    }
    for (std::size_t i = 0; i < root.size(); ++i) root[i] = find(i);
    return root;
  }

  const PolygonMesh& mesh_;
  std::vector<Cell> cells_;
  double patch_m_;
  std::vector<std::size_t> cells_in_patch_;
};

}  // namespace

std::vector<std::size_t> group_patches(const FlatPolygon& polygon, PolygonMesh& mesh,
                                       double patch_m) {
  if (mesh.elements.empty()) return {};
  std::vector<Cell> cells;
  for (std::size_t e = 0; e < mesh.elements.size(); e += mesh.per_cell) {
    Cell cell{e, {}};
    for (std::size_t k = 0; k < mesh.per_cell; ++k) {
      for (const std::uint32_t v : mesh.elements[e + k])
        cell.box.add(polygon.flat(mesh.vertices[v]));
    }
    cells.push_back(cell);
  }
  Grouping grouping(mesh, std::move(cells), patch_m);
  grouping.divide(0, mesh.elements.size() / mesh.per_cell);
  std::vector<std::array<std::uint32_t, 3>> sorted;
  sorted.reserve(mesh.elements.size());
  for (const Cell& c : grouping.cells()) {
    for (std::size_t k = 0; k < mesh.per_cell; ++k) sorted.push_back(mesh.elements[c.first + k]);
  }
  mesh.elements = std::move(sorted);
  std::vector<std::size_t> sizes;
  for (const std::size_t n : grouping.cells_in_patch()) sizes.push_back(n * mesh.per_cell);
  return sizes;
}

}  // namespace tenku
