#include "radiosity/light_on_mesh.h"

#include <algorithm>
#include <cmath>

#include "illuminance/error_budget.h"

namespace tenku {
namespace {

/// What is left of the variance of a total when those of its other parts are taken out.
double daylight_variance(const InteriorLight& light, std::size_t i) {
  const double settled = light.points.reflected_lux[i] > 0.0 ? light.corners.convergence_lux : 0.0;
  const double all = light.points.error_lux[i] - settled,
               others = interval_lux(light.corners.variance[i], light.corners.mesh_lux[i]);
  return std::max(0.0, all * all - others * others) / std::pow(interval_lux(1.0, 0.0), 2);
}

}  // namespace

LightOnMesh light_on_mesh(const ElementMesh& mesh, const Interior& interior,
                          const InteriorLight& light) {
  LightOnMesh found{mesh,         interior.points(),        {}, light.corners.variance,
                    light.is_lit, light.corners.middle_off, {}};
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    found.lux.push_back(light.points.total_lux(i));
    found.direct_variance.push_back(daylight_variance(light, i));
    found.variance[i] += found.direct_variance[i];
  }
  return found;
}

double side_lux(const LightOnMesh& light, std::size_t side) {
  const auto& [a, b, c] = light.points.corner[side];
  return (light.lux[a] + light.lux[b] + light.lux[c]) / 3.0;
}

double mean_lux(const LightOnMesh& light) {
  double lumen = 0.0, area = 0.0;
  for (std::size_t s = 0; s < light.mesh.sides(); ++s) {
    if (light.is_lit[light.points.corner[s][0]] == 0) continue;
    const double here = light.mesh.area_m2(s / 2);
    lumen += here * side_lux(light, s);
    area += here;
  }
  return area > 0.0 ? lumen / area : 0.0;
}

PointNeighbours::PointNeighbours(const LightOnMesh& light) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& corner : light.points.corner) {
    if (light.is_lit[corner[0]] == 0) continue;
    for (unsigned k = 0; k < 3; ++k) {
      edges.emplace_back(corner[k], corner[(k + 1) % 3]);
      edges.emplace_back(corner[(k + 1) % 3], corner[k]);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  begin_.assign(light.points.size() + 1, 0);
  for (const auto& [from, to] : edges) {
    ++begin_[from + 1];
    neighbour_.push_back(to);
  }
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
}

std::vector<std::uint32_t> vertices_of(const LightOnMesh& light) {
  std::vector<std::uint32_t> vertex(light.points.size());
  for (std::size_t s = 0; s < light.mesh.sides(); ++s) {
    for (unsigned k = 0; k < 3; ++k) {
      vertex[light.points.corner[s][k]] = light.mesh.elements[s / 2][k];
    }
  }
  return vertex;
}

}  // namespace tenku
