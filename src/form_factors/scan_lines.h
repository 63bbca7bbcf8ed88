/// From outlines in a plane to spans on parallel lines: what all rasterising methods share.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace tenku {

struct PlanePoint {
  double x, y;
};

/// Lines at y = first + k * step, for k from 0 to count - 1.
struct LineSet {
  double first, step;
  int count;

  double y(int line) const { return first + line * step; }
};

/// Cuts closed outlines with lines.
///
/// What lies inside is told by the even-odd rule: an outline may cross a line more than twice, as
/// one with a hollow edge does. Of an edge the lower end counts and the upper one does not, so that
/// outlines side by side leave no line out and cover none twice.
class ScanLines {
 public:
  explicit ScanLines(const LineSet& lines)
      : lines_(lines),
        per_step_(1.0 / lines.step),
        crossing_(static_cast<std::size_t>(std::max(0, lines.count))) {}

  /// Calls `emit(line, x0, x1)` for each span of the outline, x0 < x1, line after line.
  /// @param edge  `edge(k, a, b)`: of the edge from point k, which lies at a, to b, a function that
  ///              tells for y where it crosses the line there
  template <class Emit, class Edge>
  void spans(std::span<const PlanePoint> outline, const Emit& emit, const Edge& edge) {
    if (outline.empty()) return;
    int low = lines_.count, high = -1;
    std::size_t k = outline.size() - 1;
    int at_a = line_from(outline[k].y);
    for (std::size_t next = 0; next < outline.size(); k = next++) {
      const PlanePoint a = outline[k], b = outline[next];
      const int at_b = line_from(b.y), begin = std::min(at_a, at_b), end = std::max(at_a, at_b);
      at_a = at_b;
      if (begin == end) continue;
      low = std::min(low, begin), high = std::max(high, end - 1);
      const auto x_at = edge(k, a, b);
      for (int line = begin; line < end; ++line) {
        crossing_[static_cast<std::size_t>(line)].add(x_at(lines_.y(line)));
      }
    }
    for (int line = low; line <= high; ++line) {
      Crossings& at = crossing_[static_cast<std::size_t>(line)];
      if (at.count == 2) {
        const auto [x0, x1] = std::minmax(at.x[0], at.x[1]);
        if (x0 < x1) emit(line, x0, x1);
      } else {
        emit_sorted(line, at, emit);
      }
      at.count = 0;
    }
  }

  /// The same for straight edges.
  template <class Emit>
  void spans(std::span<const PlanePoint> outline, const Emit& emit) {
    spans(outline, emit, [](std::size_t, PlanePoint a, PlanePoint b) {
      const double slope = (b.x - a.x) / (b.y - a.y);
      return [a, slope](double y) { return a.x + (y - a.y) * slope; };
    });
  }

 private:
  /// A triangle cut at the horizon has four arcs, and an arc crosses a line twice at most.
  struct Crossings {
    int count = 0;
    std::array<double, 8> x;

    void add(double at) {
      if (count < static_cast<int>(x.size())) x[static_cast<std::size_t>(count++)] = at;
    }
  };

  template <class Emit>
  static void emit_sorted(int line, Crossings& at, const Emit& emit) {
    std::sort(at.x.begin(), at.x.begin() + at.count);
    for (std::size_t k = 0; k + 1 < static_cast<std::size_t>(at.count); k += 2) {
      if (at.x[k] < at.x[k + 1]) emit(line, at.x[k], at.x[k + 1]);
    }
  }

  /// First line at `y` or above it.
  int line_from(double y) const {
    const double at = (y - lines_.first) * per_step_;
    if (!(at > 0.0)) return 0;
    const int below = static_cast<int>(std::min(at, lines_.count + 1.0));
    return std::min(lines_.count, below + (at > below ? 1 : 0));
  }

  LineSet lines_;
  double per_step_;
  std::vector<Crossings> crossing_;  ///< of the outline at hand, [line]
};

}  // namespace tenku
