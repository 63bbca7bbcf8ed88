#include "radiosity/sizes_by_change.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tenku {

std::vector<double> change_per_metre(const LightOnMesh& light) {
  const PointNeighbours neighbours(light);
  const std::vector<std::uint32_t> vertex = vertices_of(light);
  const auto at = [&](std::uint32_t i) { return light.mesh.vertices[vertex[i]]; };
  std::vector<double> change(light.points.size());
  for (std::uint32_t i = 0; i < change.size(); ++i) {
    const auto near = neighbours.of(i);
    for (const std::uint32_t k : near) {
      change[i] += std::abs(light.lux[k] - light.lux[i]) / length(at(k) - at(i)) /
                   static_cast<double>(near.size());
    }
  }
  return change;
}

std::vector<double> sizes_by_change(const LightOnMesh& light, SizeRange range) {
  const std::vector<double> change = change_per_metre(light);
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (std::size_t i = 0; i < change.size(); ++i) {
    if (light.is_lit[i] == 0) continue;
    least = std::min(least, change[i]);
    most = std::max(most, change[i]);
  }
  const bool is_any = most > least;
  const double a = is_any ? (range.least_m - range.most_m) / (most - least) : 0.0,
               b = is_any ? (range.most_m * most - range.least_m * least) / (most - least)
                          : range.most_m;
  const std::vector<std::uint32_t> vertex = vertices_of(light);
  std::vector<double> size(light.mesh.vertices.size(), range.most_m);
  for (std::size_t i = 0; i < change.size(); ++i) {
    if (light.is_lit[i] != 0) size[vertex[i]] = std::min(size[vertex[i]], a * change[i] + b);
  }
  return size;
}

}  // namespace tenku
