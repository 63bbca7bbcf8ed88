#include "scene/thin_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tenku {
namespace {

using Corner = std::array<std::size_t, 2>;  // column, row

/// The tree of triangles over squares of 2^k steps that cover the grid. A point that halves
/// triangles does so for those on both sides of their longest edge, so that the mesh conforms.
class TriangleTree {
 public:
  TriangleTree(const HeightGrid& grid, const AllowedHeight& allowed)
      : grid_(grid), allowed_(allowed) {
    const std::size_t least = std::min(grid.rows, grid.columns) - 1;
    while (side_ < least) side_ *= 2;
    columns_ = side_ * ((grid.columns - 2) / side_ + 1) + 1;
    rows_ = side_ * ((grid.rows - 2) / side_ + 1) + 1;
    off_m_.assign(columns_ * rows_, 0.0F);
    is_needed_.assign(columns_ * rows_, 0);
    for (std::size_t step = 1; step < side_; step *= 2) {
      measure_edges(step);
      measure_middles(step);
    }
  }

  std::vector<std::array<std::uint32_t, 3>> triangles() {
    for (std::size_t y = 0; y + 1 < rows_; y += side_) {
      for (std::size_t x = 0; x + 1 < columns_; x += side_) {
        const Corner low{x, y}, high{x + side_, y + side_}, right{x + side_, y}, left{x, y + side_};
        const bool is_rising = (x / side_ + y / side_) % 2 == 0;  // of the diagonal
        if (is_rising) {
          add(low, high, right);
          add(high, low, left);
        } else {
          add(right, left, high);
          add(left, right, low);
        }
      }
    }
    return std::move(found_);
  }

 private:
  std::size_t at(std::size_t x, std::size_t y) const { return y * columns_ + x; }
  bool is_inside(std::size_t x, std::size_t y) const { return x < grid_.columns && y < grid_.rows; }
  double height(std::size_t x, std::size_t y) const {
    return is_inside(x, y) ? grid_.points[y * grid_.columns + x].z
                           : std::numeric_limits<double>::quiet_NaN();
  }

  /// Middles of edges along the grid, 2 steps long.
  void measure_edges(std::size_t step) {
    const std::size_t half = step / 2;
    for (std::size_t y = 0; y < rows_; y += step) {
      const bool is_row = (y / step) % 2 == 0;
      for (std::size_t x = is_row ? step : 0; x < columns_; x += 2 * step) {
        const double ends = is_row ? height(x - step, y) + height(x + step, y)
                                   : height(x, y - step) + height(x, y + step);
        std::array<std::size_t, 4> parts{};
        std::size_t count = 0;
        if (half > 0) {
          for (const std::size_t dy : {0U, 1U}) {
            for (const std::size_t dx : {0U, 1U}) {
              const bool is_out = (dx == 0 && x < half) || (dx == 1 && x + half >= columns_) ||
                                  (dy == 0 && y < half) || (dy == 1 && y + half >= rows_);
              if (is_out) continue;
              parts[count++] = at(dx == 0 ? x - half : x + half, dy == 0 ? y - half : y + half);
            }
          }
        }
        settle(x, y, step, 0.5 * ends, {parts.data(), count});
      }
    }
  }

  /// Middles of squares, 2 steps wide. The diagonal joins the corners whose numbers have an even
  /// sum: it comes from the middle of a wider square.
  void measure_middles(std::size_t step) {
    for (std::size_t y = step; y < rows_; y += 2 * step) {
      for (std::size_t x = step; x < columns_; x += 2 * step) {
        const bool is_rising = ((x - step) / (2 * step) + (y - step) / (2 * step)) % 2 == 0;
        const double ends = is_rising ? height(x - step, y - step) + height(x + step, y + step)
                                      : height(x + step, y - step) + height(x - step, y + step);
        const std::array<std::size_t, 4> parts{at(x - step, y), at(x + step, y), at(x, y - step),
                                               at(x, y + step)};
        settle(x, y, step, 0.5 * ends, parts);
      }
    }
  }

  void settle(std::size_t x, std::size_t y, std::size_t step, double foretold,
              std::span<const std::size_t> parts) {
    float below = 0.0F;
    bool is_needed = false;
    for (const std::size_t part : parts) {
      below = std::max(below, off_m_[part]);
      is_needed |= is_needed_[part] != 0;
    }
    const double off = std::abs(height(x, y) - foretold) + static_cast<double>(below);
    const std::size_t here = at(x, y);
    if (std::isnan(off)) {
      off_m_[here] = std::numeric_limits<float>::infinity();
      is_needed_[here] = 1;
      return;
    }
    off_m_[here] = static_cast<float>(off);
    is_needed_[here] =
        is_needed || !(off <= allowed_(grid_.points[y * grid_.columns + x], 2 * step));
  }

  /// @param a  to b: the longest edge
  void add(Corner a, Corner b, Corner c) {
    const std::size_t x = std::min({a[0], b[0], c[0]}), y = std::min({a[1], b[1], c[1]});
    if (x + 1 >= grid_.columns || y + 1 >= grid_.rows) return;
    const Corner twice{a[0] + b[0], a[1] + b[1]};
    const bool has_middle = twice[0] % 2 == 0 && twice[1] % 2 == 0;
    if (has_middle && is_needed_[at(twice[0] / 2, twice[1] / 2)] != 0) {
      const Corner middle{twice[0] / 2, twice[1] / 2};
      add(c, a, middle);
      add(b, c, middle);
      return;
    }
    std::array<std::uint32_t, 3> corners{};
    std::size_t count = 0;
    for (const Corner& corner : {a, b, c}) {
      if (std::isnan(height(corner[0], corner[1]))) return;
      corners[count++] = static_cast<std::uint32_t>(corner[1] * grid_.columns + corner[0]);
    }
    const Vec3 p = grid_.points[corners[0]];
    const Vec3 u = grid_.points[corners[1]] - p, v = grid_.points[corners[2]] - p;
    if (u.x * v.y - u.y * v.x < 0.0) std::swap(corners[1], corners[2]);
    found_.push_back(corners);
  }

  const HeightGrid& grid_;
  const AllowedHeight& allowed_;
  std::size_t side_ = 1, rows_ = 0, columns_ = 0;  // of a square; of all points, in steps
  std::vector<float> off_m_;                       // [point], of all halvings below
  std::vector<std::uint8_t> is_needed_;            // [point]
  std::vector<std::array<std::uint32_t, 3>> found_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> thin_grid(const HeightGrid& grid,
                                                    const AllowedHeight& allowed) {
  if (grid.rows < 2 || grid.columns < 2) return {};
  return TriangleTree(grid, allowed).triangles();
}

}  // namespace tenku
