#include "view/pixel_sharing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "core/parallel.h"
#include "core/random.h"

namespace tenku {
namespace {

constexpr int kWidest = 8;            // pixels between points at first
constexpr std::size_t kAround = 12;   // points that a plane is fitted to
constexpr int kReach = 3;             // cells of the widest kind in which they are looked for
constexpr double kStiff = 1e-3;       // of the spread: what keeps points on a line from tilting
constexpr int kBorderWidth = 2;       // pixels between points along borders, at most
constexpr double kDim = 0.01;         // of the mean light: darker values are held to it
constexpr std::uint32_t kNone = ~0U;  // no point

struct Place {
  int column, row;
};

/// What points around tell of a place.
struct Told {
  Rgb rgb{};
  double error_lux = 0.0, off_lux = 0.0;  ///< mean of theirs; root mean square off the plane
  bool is_any = false;
};

struct Near {
  double away;  ///< pixels
  std::uint32_t point;
};

double difference_lux(Rgb a, Rgb b) {
  return luminance_of({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// Weighted sums for a plane through values at places around the origin.
class PlaneFit {
 public:
  void add(double x, double y, double w, Rgb value) {
    const std::array<double, 3> basis{1.0, x, y};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) a_[i][j] += w * basis[i] * basis[j];
      b_[i] = b_[i] + (w * basis[i]) * value;
    }
  }

  /// Value at the origin and its slopes.
  std::array<Rgb, 3> solve() const {
    auto a = a_;
    std::array<Rgb, 3> b = b_;
    const double stiff = kStiff * (a[1][1] + a[2][2]) + 1e-9 * a[0][0];
    a[1][1] += stiff, a[2][2] += stiff;
    for (std::size_t k = 0; k < 3; ++k) {  // symmetric and positive: no pivoting
      for (std::size_t i = k + 1; i < 3; ++i) {
        const double f = a[i][k] / a[k][k];
        for (std::size_t j = k; j < 3; ++j) a[i][j] -= f * a[k][j];
        b[i] = b[i] + -f * b[k];
      }
    }
    for (std::size_t k = 3; k-- > 0;) {
      for (std::size_t j = k + 1; j < 3; ++j) b[k] = b[k] + -a[k][j] * b[j];
      b[k] = (1.0 / a[k][k]) * b[k];
    }
    return b;
  }

 private:
  std::array<std::array<double, 3>, 3> a_{};
  std::array<Rgb, 3> b_{};
};

/// Points whose light is known, and what they tell of others.
class PixelSharing {
 public:
  PixelSharing(const ShadingPoints& points, SensorIlluminance& light)
      : points_(points), light_(light), is_known_(points.sensors.size()) {}

  /// One point for each cell of `width` pixels of each surface in doubt that has none yet: that
  /// nearest to its middle.
  std::vector<std::uint32_t> wanted(int width, std::span<const std::uint8_t> in_doubt) const;
  void add(std::span<const std::uint32_t> points, const SensorIlluminance& values);
  /// Marks what lies about those of the points whose light the others do not tell.
  std::vector<std::uint8_t> doubts(std::span<const std::uint32_t> points, int width,
                                   double tolerance) const;
  /// @param but  a point that is left out, or none
  Told told(std::size_t point, std::uint32_t but) const;
  /// Where every pixel around is known there are contacts and creases, which a plane would blur.
  bool is_sure(std::size_t point) const;

 private:
  Place place(std::size_t point) const {
    const auto [column, row] = points_.pixel(point);
    return {column, row};
  }
  std::uint64_t key(std::size_t point, int width, int right = 0, int down = 0) const {
    const Place at = place(point);
    const std::uint64_t surface =
        points_.surface[point] + (points_.is_seen_directly[point] ? 1 : 0);
    return mix_rounded(surface, {at.column / width + right + 0.0, at.row / width + down + 0.0});
  }
  std::vector<Near> around(std::size_t point, std::uint32_t but) const;
  double mean_lux() const;

  const ShadingPoints& points_;
  SensorIlluminance& light_;
  std::vector<std::uint8_t> is_known_;
  std::vector<std::uint32_t> known_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> in_cell_;
};

std::vector<std::uint32_t> PixelSharing::wanted(int width,
                                                std::span<const std::uint8_t> in_doubt) const {
  struct Cell {
    std::uint32_t point = kNone;
    int away = 0;
    bool is_known = false;
  };
  std::unordered_map<std::uint64_t, Cell> cells;
  std::vector<std::uint64_t> order;
  for (std::uint32_t i = 0; i < points_.sensors.size(); ++i) {
    if (in_doubt[i] == 0) continue;
    const auto [found, is_new] = cells.try_emplace(key(i, width));
    if (is_new) order.push_back(found->first);
    Cell& cell = found->second;
    cell.is_known |= is_known_[i] != 0;
    const Place at = place(i);
    const int away =
        std::abs(2 * (at.column % width) + 1 - width) + std::abs(2 * (at.row % width) + 1 - width);
    if (cell.point == kNone || away < cell.away) cell.point = i, cell.away = away;
  }
  std::vector<std::uint32_t> wanted;
  for (const std::uint64_t k : order) {
    if (!cells[k].is_known) wanted.push_back(cells[k].point);
  }
  return wanted;
}

void PixelSharing::add(std::span<const std::uint32_t> points, const SensorIlluminance& values) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::uint32_t i = points[k];
    is_known_[i] = 1;
    known_.push_back(i);
    in_cell_[key(i, kWidest)].push_back(i);
    light_.reflected_rgb[i] = values.reflected_rgb[k];
    light_.error_lux[i] = values.error_lux[k];
  }
}

std::vector<Near> PixelSharing::around(std::size_t point, std::uint32_t but) const {
  const Place at = place(point);
  std::vector<Near> near;
  for (int reach = 0; reach <= kReach; ++reach) {
    for (int down = -reach; down <= reach; ++down) {
      const int step = std::abs(down) == reach || reach == 0 ? 1 : 2 * reach;
      for (int right = -reach; right <= reach; right += step) {
        const auto found = in_cell_.find(key(point, kWidest, right, down));
        if (found == in_cell_.end()) continue;
        for (const std::uint32_t k : found->second) {
          const Place there = place(k);
          if (k == but) continue;
          near.push_back({std::hypot(there.column - at.column, there.row - at.row), k});
        }
      }
    }
    const auto sure = std::count_if(near.begin(), near.end(),
                                    [&](const Near& n) { return n.away <= kWidest * reach; });
    if (static_cast<std::size_t>(sure) >= kAround) break;
  }
  const auto count = std::min(kAround, near.size());
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end(),
                    [](const Near& a, const Near& b) {
                      return a.away != b.away ? a.away < b.away : a.point < b.point;
                    });
  near.resize(count);
  return near;
}

Told PixelSharing::told(std::size_t point, std::uint32_t but) const {
  const std::vector<Near> near = around(point, but);
  Told told;
  if (near.empty()) return told;
  told.is_any = true;
  const Place at = place(point);
  const double wide = 1.1 * near.back().away + 0.5;
  const auto weight = [&](const Near& n) { return std::pow(1.0 - std::pow(n.away / wide, 2), 2); };
  const auto offset = [&](const Near& n) {
    const Place there = place(n.point);
    return std::array<double, 2>{there.column - at.column + 0.0, there.row - at.row + 0.0};
  };
  PlaneFit fit;
  Rgb least = light_.reflected_rgb[near.front().point], most = least;
  for (const Near& n : near) {
    const Rgb value = light_.reflected_rgb[n.point];
    const auto [x, y] = offset(n);
    fit.add(x, y, weight(n), value);
    least = {std::min(least.r, value.r), std::min(least.g, value.g), std::min(least.b, value.b)};
    most = {std::max(most.r, value.r), std::max(most.g, value.g), std::max(most.b, value.b)};
  }
  const auto [value, right, down] = fit.solve();
  // A slope may lead on beyond what is known, but not far.
  const auto kept = [](double v, double low, double high) {
    return std::clamp(v, std::max(0.0, low - 0.5 * (high - low)), high + 0.5 * (high - low));
  };
  told.rgb = {kept(value.r, least.r, most.r), kept(value.g, least.g, most.g),
              kept(value.b, least.b, most.b)};
  double weights = 0.0, squares = 0.0;
  for (const Near& n : near) {
    const auto [x, y] = offset(n);
    const double off = difference_lux(light_.reflected_rgb[n.point], value + x * right + y * down);
    weights += weight(n), squares += weight(n) * off * off;
    told.error_lux += weight(n) * light_.error_lux[n.point];
  }
  told.error_lux /= weights;
  told.off_lux = std::sqrt(squares / weights);
  return told;
}

bool PixelSharing::is_sure(std::size_t point) const {
  if (is_known_[point] == 0) return false;
  bool all = true;
  points_.for_each_near(point, 1, [&](std::uint32_t k, double) { all &= is_known_[k] != 0; });
  return all;
}

double PixelSharing::mean_lux() const {
  double sum = 0.0;
  for (const std::uint32_t i : known_) sum += luminance_of(light_.reflected_rgb[i]);
  return sum / static_cast<double>(std::max<std::size_t>(known_.size(), 1));
}

std::vector<std::uint8_t> PixelSharing::doubts(std::span<const std::uint32_t> points, int width,
                                               double tolerance) const {
  const double floor_lux = kDim * mean_lux();
  std::vector<std::uint8_t> is_told(points.size());
  parallel_for(points.size(), 64, [&](IndexRange range) {
    for (std::size_t k = range.begin; k < range.end; ++k) {
      const Rgb own = light_.reflected_rgb[points[k]];
      const Told others = told(points[k], points[k]);
      const double allowed = tolerance * std::max(luminance_of(own), floor_lux);
      is_told[k] = others.is_any && difference_lux(own, others.rgb) <= allowed;
    }
  });
  std::vector<std::uint8_t> in_doubt(points_.sensors.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (is_told[k] != 0) continue;
    points_.for_each_near(points[k], width, [&](std::uint32_t i, double) { in_doubt[i] = 1; });
  }
  return in_doubt;
}

/// Marks the points at the border of their surface, of which those within tell only by going on.
void add_borders(const ShadingPoints& points, std::vector<std::uint8_t>& in_doubt) {
  constexpr int kAll = 9;  // pixels with those around
  parallel_for(in_doubt.size(), 1024, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      std::uint32_t pixels = 0, last = kNone;
      points.for_each_near(i, 1, [&](std::uint32_t k, double) {
        pixels += points.pixel_index[k] != last;
        last = points.pixel_index[k];
      });
      if (pixels < kAll) in_doubt[i] = 1;
    }
  });
}

}  // namespace

std::vector<std::uint32_t> share_by_pixels(const ShadingPoints& points, double tolerance,
                                           const PixelLightFinder& find, SensorIlluminance& light) {
  const std::vector<double> direct_error = light.error_lux;
  PixelSharing sharing(points, light);
  std::vector<std::uint8_t> in_doubt(points.sensors.size(), 1);
  for (int width = kWidest; width >= 1; width /= 2) {
    if (width == kBorderWidth) add_borders(points, in_doubt);
    const std::vector<std::uint32_t> wanted = sharing.wanted(width, in_doubt);
    if (!wanted.empty()) sharing.add(wanted, find(wanted));
    in_doubt = sharing.doubts(wanted, width, tolerance);
  }
  std::vector<Told> told(points.sensors.size());
  parallel_for(told.size(), 256, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      told[i] = sharing.is_sure(i) ? Told{light.reflected_rgb[i], light.error_lux[i], 0.0, true}
                                   : sharing.told(i, kNone);
    }
  });
  for (std::size_t i = 0; i < told.size(); ++i) {
    light.set_reflected(i, told[i].rgb);
    light.error_lux[i] = std::hypot(direct_error[i], told[i].error_lux, told[i].off_lux);
  }
  std::vector<std::uint32_t> untold;
  for (std::uint32_t i = 0; i < in_doubt.size(); ++i) {
    if (in_doubt[i] != 0) untold.push_back(i);
  }
  return untold;
}

}  // namespace tenku
