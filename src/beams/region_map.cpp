#include "beams/region_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

std::uint32_t layer_of(const BeamTree& tree, std::uint32_t region) {
  return tree.beams[tree.regions[region].beam].layer;
}

/// Calls `visit(x, y, place)` for the places of some rows that a region covers.
template <class Visit>
void for_each_place(const std::vector<WindowPoint>& corners, int width, IndexRange rows,
                    std::span<const WindowPoint> places, const Visit& visit) {
  const int first = static_cast<int>(rows.begin), last = static_cast<int>(rows.end);
  const auto [lowest, highest] = std::minmax_element(
      corners.begin(), corners.end(), [](WindowPoint a, WindowPoint b) { return a.v < b.v; });
  if (highest->v < first || lowest->v > last) return;
  const int top = std::max(first, static_cast<int>(std::floor(lowest->v)) - 1),
            bottom = std::min(last, static_cast<int>(std::ceil(highest->v)) + 1);
  for (int y = top; y < bottom; ++y) {
    for (std::size_t s = 0; s < places.size(); ++s) {
      const Span span = span_at(corners, y + places[s].v);
      if (!(span.low <= span.high)) continue;
      const double left = std::ceil(span.low - kOverlap - places[s].u),
                   right = std::floor(span.high + kOverlap - places[s].u);
      const int begin = std::max(0, static_cast<int>(left)),
                end = std::min(width - 1, static_cast<int>(right));
      for (int x = begin; x <= end; ++x) visit(x, y, s);
    }
  }
}

/// Of all regions of layer 0 the one that the place is least outside of.
std::uint32_t nearest_region(const BeamTree& tree, WindowPoint p) {
  double best = -std::numeric_limits<double>::infinity();
  std::uint32_t found = 0;
  for (std::uint32_t r = 0; r < tree.regions.size(); ++r) {
    if (layer_of(tree, r) != 0) continue;
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
  for (std::uint32_t r = 0; r < tree.regions.size(); ++r) {
    if (layer_of(tree, r) != 0) mirrored_.push_back(r);
  }
  std::stable_sort(mirrored_.begin(), mirrored_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return layer_of(tree, a) < layer_of(tree, b);
  });
  bands_.resize(static_cast<std::size_t>((height + kRows - 1) / kRows));
  parallel_for(bands_.size(), 1, [&](IndexRange range) {
    for (std::size_t b = range.begin; b < range.end; ++b) {
      const int first = static_cast<int>(b) * kRows, last = std::min(height, first + kRows);
      fill_rows(tree, first, last, places);
      bands_[b] = mirrored_in(tree, first, last, places);
    }
  });
}

std::span<const std::uint32_t> RegionMap::mirrored_at(std::size_t pixel, std::size_t place) const {
  if (mirrored_.empty()) return {};
  const std::size_t pixels = static_cast<std::size_t>(width_) * kRows;
  const Band& band = bands_[pixel / pixels];
  if (band.first.empty()) return {};
  const std::size_t cell = pixel % pixels * places_ + place;
  return {band.region.data() + band.first[cell], band.first[cell + 1] - band.first[cell]};
}

RegionMap::Band RegionMap::mirrored_in(const BeamTree& tree, int first, int last,
                                       std::span<const WindowPoint> places) const {
  struct Found {
    std::size_t cell;
    std::uint32_t region;
  };
  const auto cells =
      static_cast<std::size_t>(last - first) * static_cast<std::size_t>(width_) * places_;
  std::vector<Found> found;
  std::vector<std::uint32_t> latest(mirrored_.empty() ? 0 : cells, kNoFace);  // of `found`
  const IndexRange rows{static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
  for (const std::uint32_t r : mirrored_) {
    for_each_place(tree.regions[r].corners, width_, rows, places, [&](int x, int y, std::size_t s) {
      const std::size_t at =
          (static_cast<std::size_t>(y - first) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x)) *
              places_ +
          s;
      // On a common border of two regions the later takes the place, as in layer 0.
      if (latest[at] != kNoFace && layer_of(tree, found[latest[at]].region) == layer_of(tree, r)) {
        found[latest[at]].region = r;
        return;
      }
      latest[at] = static_cast<std::uint32_t>(found.size());
      found.push_back({at, r});
    });
  }
  Band band;
  if (found.empty()) return band;
  band.first.assign(cells + 1, 0);
  for (const Found& f : found) ++band.first[f.cell + 1];
  std::partial_sum(band.first.begin(), band.first.end(), band.first.begin());
  band.region.resize(found.size());
  std::vector<std::uint32_t> next(band.first.begin(), band.first.end() - 1);
  for (const Found& f : found) band.region[next[f.cell]++] = f.region;
  return band;
}

void RegionMap::fill_rows(const BeamTree& tree, int first, int last,
                          std::span<const WindowPoint> places) {
  const auto cell = [&](int x, int y, std::size_t s) -> std::uint32_t& {
    const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                       static_cast<std::size_t>(x);
    return region_[pixel * places_ + s];
  };
  const IndexRange rows{static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
  for (std::uint32_t r = 0; r < tree.regions.size(); ++r) {
    if (layer_of(tree, r) != 0) continue;
    for_each_place(tree.regions[r].corners, width_, rows, places,
                   [&](int x, int y, std::size_t s) { cell(x, y, s) = r; });
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
