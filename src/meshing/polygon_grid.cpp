#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "meshing/polygon_mesh.h"

namespace tenku {
namespace {

constexpr double kLongestCell = 4.0;  // times its width

/// Parallel lines through the corners, and those that divide the strips between them.
struct Lines {
  std::vector<double> at;         ///< of all lines
  std::vector<std::size_t> main;  ///< which of them go through corners

  std::size_t cells() const { return at.size() - 1; }
};

/// Values, those within `apart` of one another made one.
std::vector<double> distinct(std::vector<double> values, double apart) {
  std::sort(values.begin(), values.end());
  std::vector<double> kept;
  for (const double v : values) {
    if (kept.empty() || v - kept.back() > apart) kept.push_back(v);
  }
  return kept;
}

std::size_t nearest(std::span<const double> sorted, double value) {
  const auto above = static_cast<std::size_t>(
      std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
  if (above == sorted.size()) return above - 1;
  if (above == 0 || sorted[above] - value < value - sorted[above - 1]) return above;
  return above - 1;
}

double parts(double length, double most) { return std::max(1.0, std::ceil(length / most - 1e-9)); }

Lines divided(std::span<const double> main, double most) {
  Lines lines;
  for (std::size_t i = 0; i + 1 < main.size(); ++i) {
    lines.main.push_back(lines.at.size());
    const double n = parts(main[i + 1] - main[i], most);
    for (double k = 0.0; k < n; ++k) {
      lines.at.push_back(main[i] + (k / n) * (main[i + 1] - main[i]));
    }
  }
  lines.main.push_back(lines.at.size());
  lines.at.push_back(main.back());
  return lines;
}

struct CellSize {
  double width, height;
};

/// Cells of a rectangle with diagonals up to `element_m`: few, and not far from square.
CellSize best_cell(double width, double height, double element_m) {
  CellSize best{};
  double best_cost = 0.0;
  const double square = std::numbers::sqrt2 / 2.0 * element_m;
  const auto most = parts(height, square) + 1.0;
  for (double rows = std::max(1.0, most - 2.0); rows <= most; ++rows) {
    const double h = height / rows;
    if (h >= element_m) continue;
    const double columns = parts(width, std::sqrt(element_m * element_m - h * h));
    const double w = width / columns;
    const double cost = rows * columns * (w / h + h / w);
    if (best_cost > 0.0 && cost >= best_cost) continue;
    best_cost = cost;
    best = {w, h};
  }
  return best;
}

/// Corner of the polygon on the grid: which of the lines meet there.
struct Node {
  std::size_t column, row;
};

class Grid {
 public:
  Grid(Lines columns, Lines rows) : x_(std::move(columns)), y_(std::move(rows)) {
    parity_.assign(x_.at.size() * y_.at.size(), 0);
    place_.resize(parity_.size());
    is_placed_.assign(parity_.size(), 0);
  }

  std::size_t index(std::size_t column, std::size_t row) const {
    return row * x_.at.size() + column;
  }

  /// An edge of the polygon between two of its corners: the nodes on it lie exactly on it.
  void add_edge(Node a, Node b, Vec3 from, Vec3 to) {
    const bool is_upright = a.column == b.column;
    const auto along = [&](Node n) { return is_upright ? y_.at[n.row] : x_.at[n.column]; };
    if (is_upright ? b.row < a.row : b.column < a.column) {
      std::swap(a, b);
      std::swap(from, to);
    }
    for (Node n = a;; ++(is_upright ? n.row : n.column)) {
      const bool is_end = is_upright ? n.row == b.row : n.column == b.column;
      const double t = is_end ? 1.0 : (along(n) - along(a)) / (along(b) - along(a));
      place_[index(n.column, n.row)] = is_end ? to : from + t * (to - from);
      is_placed_[index(n.column, n.row)] = 1;
      if (is_end) return;
      if (is_upright) parity_[index(n.column, n.row)] ^= 1;
    }
  }

  /// Calls `visit(column, row)` for the cells inside.
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    for (std::size_t row = 0; row < y_.cells(); ++row) {
      std::uint8_t is_inside = 0;
      for (std::size_t column = 0; column < x_.cells(); ++column) {
        is_inside ^= parity_[index(column, row)];
        if (is_inside != 0) visit(column, row);
      }
    }
  }

  double slenderness() const {
    double worst = 1.0;
    for_each_cell([&](std::size_t column, std::size_t row) {
      const double ratio = (x_.at[column + 1] - x_.at[column]) / (y_.at[row + 1] - y_.at[row]);
      worst = std::max({worst, ratio, 1.0 / ratio});
    });
    return worst;
  }

  PolygonMesh mesh(const FlatPolygon& polygon) const {
    PolygonMesh made;
    made.per_cell = 2;
    constexpr std::uint32_t kUnused = 0xffffffffU;
    std::vector<std::uint32_t> number(place_.size(), kUnused);
    const auto vertex = [&](std::size_t column, std::size_t row) {
      const std::size_t node = index(column, row);
      if (number[node] == kUnused) {
        number[node] = static_cast<std::uint32_t>(made.vertices.size());
        made.vertices.push_back(
            is_placed_[node] != 0 ? place_[node] : polygon.lifted({x_.at[column], y_.at[row]}));
      }
      return number[node];
    };
    for_each_cell([&](std::size_t column, std::size_t row) {
      const std::uint32_t a = vertex(column, row), b = vertex(column + 1, row),
                          c = vertex(column + 1, row + 1), d = vertex(column, row + 1);
      made.elements.push_back({a, b, c});
      made.elements.push_back({a, c, d});
    });
    return made;
  }

 private:
  Lines x_, y_;
  std::vector<std::uint8_t> parity_;  ///< [node] whether the edge above it bounds the surface
  std::vector<Vec3> place_;           ///< [node] on the outline
  std::vector<std::uint8_t> is_placed_;
};

/// Whether every edge runs along one of the lines through corners.
bool follows(const FlatPolygon& polygon, std::span<const double> x, std::span<const double> y) {
  for (const auto& ring : polygon.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const PlanePoint a = polygon.flat(ring[i]), b = polygon.flat(ring[(i + 1) % ring.size()]);
      const bool is_upright = nearest(x, a.x) == nearest(x, b.x);
      const bool is_level = nearest(y, a.y) == nearest(y, b.y);
      if (is_upright == is_level) return false;
    }
  }
  return true;
}

/// Lines from the many corners of a jagged outline would cut it finer than it needs.
bool are_too_many(const Lines& columns, const Lines& rows, double square) {
  constexpr double kMostTimes = 3.0, kFew = 64.0;
  const double needed = (columns.at.back() - columns.at.front()) *
                        (rows.at.back() - rows.at.front()) / (square * square);
  return static_cast<double>(columns.cells()) * static_cast<double>(rows.cells()) >
         kMostTimes * needed + kFew;
}

}  // namespace

std::optional<PolygonMesh> grid_mesh(const FlatPolygon& polygon, double element_m, double apart_m) {
  std::vector<double> x, y;
  for (const auto& ring : polygon.rings) {
    for (const Vec3 corner : ring) {
      const PlanePoint p = polygon.flat(corner);
      x.push_back(p.x);
      y.push_back(p.y);
    }
  }
  x = distinct(std::move(x), apart_m);
  y = distinct(std::move(y), apart_m);
  if (x.size() < 2 || y.size() < 2 || !follows(polygon, x, y)) return std::nullopt;
  const bool is_rectangle = x.size() == 2 && y.size() == 2;
  const double square = std::numbers::sqrt2 / 2.0 * element_m;
  const CellSize cell =
      is_rectangle ? best_cell(x[1] - x[0], y[1] - y[0], element_m) : CellSize{square, square};
  const Lines columns = divided(x, cell.width), rows = divided(y, cell.height);
  if (!is_rectangle && are_too_many(columns, rows, square)) return std::nullopt;
  Grid grid(columns, rows);
  const auto node_of = [&](Vec3 corner) {
    const PlanePoint p = polygon.flat(corner);
    return Node{columns.main[nearest(x, p.x)], rows.main[nearest(y, p.y)]};
  };
  for (const auto& ring : polygon.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec3 from = ring[i], to = ring[(i + 1) % ring.size()];
      grid.add_edge(node_of(from), node_of(to), from, to);
    }
  }
  if (!is_rectangle && grid.slenderness() > kLongestCell) return std::nullopt;
  return grid.mesh(polygon);
}

}  // namespace tenku
