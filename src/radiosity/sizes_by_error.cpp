#include "radiosity/sizes_by_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>

#include "core/parallel.h"

namespace tenku {
namespace {

constexpr double kBend = 0.12, kMiddle = 0.7, kOrder = 2.0;  // see the header
constexpr double kFineShare = 0.25;   // of the present size: no less in one step
constexpr double kCoarseShare = 8.0;  // nor more
constexpr double kAlongLine = 1.2;    // of the height of an element over an edge on a line
constexpr double kNoise = 1.5;        // standard deviations that are noise
constexpr double kBendNoise = 5.3;    // variance of a bend by that of corners: (4 / sqrt(3))^2
constexpr double kMiddleNoise = 4.0 / 3.0;
constexpr std::size_t kGrain = 256;

/// How the light that is drawn bends at the edges of sides.
class Bends {
 public:
  Bends(const LightOnMesh& light, std::span<const std::uint8_t> is_bent)
      : light_(light), is_bent_(is_bent), beyond_(light.mesh.sides(), {kNone, kNone, kNone}) {
    struct Edge {
      std::uint32_t low, high, side;
      unsigned edge;
    };
    std::vector<Edge> edges;
    for (std::uint32_t s = 0; s < beyond_.size(); ++s) {
      const auto& corner = light.points.corner[s];
      if (light.is_lit[corner[0]] == 0) continue;
      for (unsigned k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(corner[k], corner[(k + 1) % 3]);
        edges.push_back({low, high, s, k});
      }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
      return std::tie(a.low, a.high, a.side) < std::tie(b.low, b.high, b.side);
    });
    for (std::size_t i = 1; i < edges.size(); ++i) {
      const Edge &a = edges[i - 1], &b = edges[i];
      if (a.low != b.low || a.high != b.high) continue;
      beyond_[a.side][a.edge] = b.side;
      beyond_[b.side][b.edge] = a.side;
    }
  }

  /// Root mean square over the edges of a side, lux per metre.
  double at(std::size_t side) const {
    const Vec3 here = slope(side);
    double square = 0.0;
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t next = beyond_[side][k];
      if (next == kNone || is_known(side, k)) continue;
      const Vec3 bend = slope(next) - here;
      square += dot(bend, bend);
    }
    return std::sqrt(square / 3.0);
  }

 private:
  static constexpr std::uint32_t kNone = ~0U;

  bool is_known(std::size_t side, unsigned edge) const {
    return !is_bent_.empty() && (is_bent_[side / 2] >> edge & 1U) != 0;
  }

  /// Of the light that is drawn, lux per metre.
  Vec3 slope(std::size_t side) const {
    const auto& [a, b, c] = light_.mesh.elements[side / 2];
    const auto& corner = light_.points.corner[side];
    const Vec3 u = light_.mesh.vertices[b] - light_.mesh.vertices[a],
               v = light_.mesh.vertices[c] - light_.mesh.vertices[a], n = cross(u, v);
    const double along_u = light_.lux[corner[1]] - light_.lux[corner[0]],
                 along_v = light_.lux[corner[2]] - light_.lux[corner[0]];
    return (1.0 / dot(n, n)) * (along_u * cross(v, n) + along_v * cross(n, u));
  }

  const LightOnMesh& light_;
  std::span<const std::uint8_t> is_bent_;
  std::vector<std::array<std::uint32_t, 3>> beyond_;  ///< [side][edge], the side on the other hand
};

InterpolationError error_of(const LightOnMesh& light, const Bends& bends, std::size_t side) {
  InterpolationError found;
  found.size_m = light.mesh.mean_edge_m(side / 2);
  double variance = 0.0, direct = 0.0;
  for (const std::uint32_t i : light.points.corner[side]) {
    variance += light.variance[i] / 3.0;
    direct += light.direct_variance[i] / 3.0;
  }
  const auto beyond_noise = [](double off, double noise) {
    return std::max(0.0, off * off - kNoise * kNoise * noise);
  };
  const double bend = beyond_noise(found.size_m * bends.at(side), kBendNoise * variance),
               middle = beyond_noise(light.middle_off[side], kMiddleNoise * direct);
  found.lux = std::sqrt(kBend * kBend * bend + kMiddle * kMiddle * middle);
  return found;
}

/// Calls `use(side, its area)` for lit sides.
template <class Use>
void for_lit(const LightOnMesh& light, const Use& use) {
  for (std::size_t s = 0; s < light.mesh.sides(); ++s) {
    if (light.is_lit[light.points.corner[s][0]] != 0) use(s, light.mesh.area_m2(s / 2));
  }
}

/// Size with which an element has this share of the squared error, lux^2 m^2.
double size_for(const InterpolationError& error, double share, const SizeRange& range) {
  double size = range.most_m;
  if (error.lux > 0.0) {
    const double now = std::pow(error.lux * error.size_m, 2);
    size = error.size_m * std::pow(share / now, 1.0 / (2.0 + 2.0 * kOrder));
  }
  return std::clamp(size, range.least_m, std::max(range.least_m, range.most_m));
}

/// As far towards it as one step goes.
double next_size(const InterpolationError& error, double size, const SizeRange& range) {
  size = std::clamp(size, kFineShare * error.size_m, kCoarseShare * error.size_m);
  return std::clamp(size, range.least_m, std::max(range.least_m, range.most_m));
}

/// Along a line elements that are much larger than the space to the next line would lose it.
std::vector<double> most_sizes(const ElementMesh& mesh, std::span<const std::uint8_t> is_bent,
                               double most_m) {
  std::vector<double> size(mesh.size(), most_m);
  for (std::size_t e = 0; e < is_bent.size(); ++e) {
    for (unsigned k = 0; k < 3; ++k) {
      if ((is_bent[e] >> k & 1U) == 0) continue;
      const Vec3 edge =
          mesh.vertices[mesh.elements[e][(k + 1) % 3]] - mesh.vertices[mesh.elements[e][k]];
      size[e] = std::min(size[e], kAlongLine * 2.0 * mesh.area_m2(e) / length(edge));
    }
  }
  return size;
}

/// What sizes for a share come to.
struct Outlook {
  double square = 0.0;    ///< error in the end, lux^2 m^2
  double elements = 0.0;  ///< after this step
};

Outlook outlook(const LightOnMesh& light, const std::vector<InterpolationError>& error,
                std::span<const double> most_m, double share, const SizeRange& range) {
  constexpr double kPerArea = 2.309;  // equilateral triangles: 4 / sqrt(3)
  Outlook sum;
  std::vector<double> element_size(most_m.begin(), most_m.end());
  for_lit(light, [&](std::size_t s, double area) {
    const double size = std::min(size_for(error[s], share, range), most_m[s / 2]);
    element_size[s / 2] = std::min(element_size[s / 2], next_size(error[s], size, range));
    sum.square += area * std::pow(error[s].lux * std::pow(size / error[s].size_m, kOrder), 2);
  });
  for (std::size_t e = 0; e < element_size.size(); ++e) {
    sum.elements += kPerArea * light.mesh.area_m2(e) / (element_size[e] * element_size[e]);
  }
  return sum;
}

}  // namespace

std::vector<InterpolationError> interpolation_error(const LightOnMesh& light,
                                                    std::span<const std::uint8_t> is_bent) {
  const Bends bends(light, is_bent);
  std::vector<InterpolationError> error(light.mesh.sides());
  parallel_for(error.size(), kGrain, [&](IndexRange range) {
    for (std::size_t s = range.begin; s < range.end; ++s) {
      if (light.is_lit[light.points.corner[s][0]] != 0) error[s] = error_of(light, bends, s);
    }
  });
  return error;
}

double interpolation_rms(const LightOnMesh& light, const std::vector<InterpolationError>& error) {
  double square = 0.0, area = 0.0;
  for_lit(light, [&](std::size_t s, double here) {
    square += here * error[s].lux * error[s].lux;
    area += here;
  });
  return area > 0.0 ? std::sqrt(square / area) : 0.0;
}

std::vector<double> sizes_by_error(const LightOnMesh& light,
                                   const std::vector<InterpolationError>& error,
                                   const ErrorSizes& asked, std::span<const std::uint8_t> is_bent) {
  std::vector<double> size = most_sizes(light.mesh, is_bent, asked.range.most_m);
  double lit = 0.0;
  for_lit(light, [&](std::size_t, double area) { lit += area; });
  const double allowed = asked.allowed_lux * asked.allowed_lux * lit;
  const auto most = static_cast<double>(asked.elements_max);
  const auto is_too_fine = [&](double share) {
    const Outlook is = outlook(light, error, size, share, asked.range);
    return (asked.elements_max > 0 && is.elements > most) || is.square < allowed;
  };
  double low = -120.0, high = 120.0;  // powers of two of the share
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (is_too_fine(std::exp2(middle)) ? low : high) = middle;
  }
  for_lit(light, [&](std::size_t s, double) {
    const double wished = size_for(error[s], std::exp2(high), asked.range);
    size[s / 2] = std::min(size[s / 2], next_size(error[s], wished, asked.range));
  });
  return size;
}

}  // namespace tenku
