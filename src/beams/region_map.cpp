#include "beams/region_map.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace tenku {
namespace {

/// Regions are filled by this much more than they are, in pixels, so that rounding leaves no gap.
constexpr double kOverlap = 1e-6;
constexpr int kRows = 16;  // filled together

struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

/// Where a line of constant v meets a convex polygon.
Span span_at(const std::vector<WindowPoint>& corners, double v) {
  Span span;
  const auto add = [&](double u) {
    span.low = std::min(span.low, u);
    span.high = std::max(span.high, u);
  };
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const WindowPoint a = corners[k], b = corners[k + 1 < corners.size() ? k + 1 : 0];
    const double low = std::min(a.v, b.v), high = std::max(a.v, b.v);
    if (v < low - kOverlap || v > high + kOverlap) continue;
    if (high - low < kOverlap) {
      add(a.u);
      add(b.u);
    } else {
      add(a.u + std::clamp((v - a.v) / (b.v - a.v), 0.0, 1.0) * (b.u - a.u));
    }
  }
  return span;
}

/// Of all regions the one that the place is least outside of.
std::uint32_t nearest_region(const BeamTree& tree, WindowPoint p) {
  double best = -std::numeric_limits<double>::infinity();
  std::uint32_t found = 0;
  for (std::uint32_t r = 0; r < tree.regions.size(); ++r) {
    const auto& corners = tree.regions[r].corners;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const WindowPoint a = corners[k], b = corners[k + 1 < corners.size() ? k + 1 : 0];
      const double du = b.u - a.u, dv = b.v - a.v, size = std::hypot(du, dv);
      if (size > 0.0) least = std::min(least, (du * (p.v - a.v) - dv * (p.u - a.u)) / size);
    }
    if (least > best) best = least, found = r;
  }
  return found;
}

}  // namespace

RegionMap::RegionMap(const BeamTree& tree, int width, int height,
                     std::span<const WindowPoint> places)
    : width_(width),
      places_(places.size()),
      region_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * places.size(),
              kNoFace) {
  const int bands = (height + kRows - 1) / kRows;
  parallel_for(static_cast<std::size_t>(bands), 1, [&](IndexRange range) {
    for (std::size_t b = range.begin; b < range.end; ++b) {
      const int first = static_cast<int>(b) * kRows;
      fill_rows(tree, first, std::min(height, first + kRows), places);
    }
  });
}

void RegionMap::fill_rows(const BeamTree& tree, int first, int last,
                          std::span<const WindowPoint> places) {
  const auto cell = [&](int x, int y, std::size_t s) -> std::uint32_t& {
    const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                       static_cast<std::size_t>(x);
    return region_[pixel * places_ + s];
  };
  for (std::uint32_t r = 0; r < tree.regions.size(); ++r) {
    const auto& corners = tree.regions[r].corners;
    const auto [lowest, highest] = std::minmax_element(
        corners.begin(), corners.end(), [](WindowPoint a, WindowPoint b) { return a.v < b.v; });
    if (highest->v < first || lowest->v > last) continue;
    const int top = std::max(first, static_cast<int>(std::floor(lowest->v)) - 1),
              bottom = std::min(last, static_cast<int>(std::ceil(highest->v)) + 1);
    for (int y = top; y < bottom; ++y) {
      for (std::size_t s = 0; s < places_; ++s) {
        const Span span = span_at(corners, y + places[s].v);
        if (!(span.low <= span.high)) continue;
        const double left = std::ceil(span.low - kOverlap - places[s].u),
                     right = std::floor(span.high + kOverlap - places[s].u);
        const int begin = std::max(0, static_cast<int>(left)),
                  end = std::min(width_ - 1, static_cast<int>(right));
        for (int x = begin; x <= end; ++x) cell(x, y, s) = r;
      }
    }
  }
  for (int y = first; y < last; ++y) {
    for (int x = 0; x < width_; ++x) {
      for (std::size_t s = 0; s < places_; ++s) {
        if (cell(x, y, s) == kNoFace) {
          cell(x, y, s) = nearest_region(tree, {x + places[s].u, y + places[s].v});
        }
      }
    }
  }
}

}  // namespace tenku
