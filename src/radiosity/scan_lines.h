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
      : lines_(lines), crossing_(static_cast<std::size_t>(std::max(0, lines.count))) {}

  /// Calls `emit(line, x0, x1)` for each span of the outline, x0 < x1, line after line.
  /// @param crossing  `crossing(k, y, x)`: where the edge from point k, which crosses the line at y
  ///                  in x if it is straight, really does
  template <class Emit, class Crossing>
  void spans(std::span<const PlanePoint> outline, const Emit& emit, const Crossing& crossing) {
    int low = lines_.count, high = -1;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const PlanePoint a = outline[k], b = outline[k + 1 < outline.size() ? k + 1 : 0];
      const PlanePoint &bottom = a.y < b.y ? a : b, &top = a.y < b.y ? b : a;
      const int begin = line_from(bottom.y), end = line_from(top.y);
      if (begin >= end) continue;
      low = std::min(low, begin), high = std::max(high, end - 1);
      const double slope = (top.x - bottom.x) / (top.y - bottom.y);
      for (int line = begin; line < end; ++line) {
        const double y = lines_.y(line), x = bottom.x + (y - bottom.y) * slope;
        crossing_[static_cast<std::size_t>(line)].add(crossing(k, y, x));
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
    spans(outline, emit, [](std::size_t, double, double x) { return x; });
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
    const double line = std::ceil((y - lines_.first) / lines_.step);
    return static_cast<int>(std::clamp(line, 0.0, static_cast<double>(lines_.count)));
  }

  LineSet lines_;
  std::vector<Crossings> crossing_;  ///< of the outline at hand, [line]
};

}  // namespace tenku
