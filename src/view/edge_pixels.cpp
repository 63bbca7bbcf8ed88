#include "view/edge_pixels.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.h"

namespace tenku {
namespace {

constexpr double kDim = 0.01;  // of the mean light: darker values are held to it

double mean_lux(const SensorIlluminance& light) {
  double sum = 0.0;
  for (const double lux : light.reflected_lux) sum += lux;
  return sum / static_cast<double>(std::max<std::size_t>(light.size(), 1));
}

/// Places of some points' rays.
///
/// Shape  `first` [chosen + 1], `point` [place]
struct Places {
  Sensors sensors;
  std::vector<std::uint32_t> point;
  std::vector<std::size_t> first{0};
};

Places places_of(const PixelRays& pixels, std::span<const std::uint32_t> chosen) {
  std::vector<std::vector<Vec3>> of_point(chosen.size());
  parallel_for(chosen.size(), 256, [&](IndexRange range) {
    for (std::size_t k = range.begin; k < range.end; ++k) {
      of_point[k] = places_of_rays(pixels.points, chosen[k], pixels.paths, pixels.rays);
    }
  });
  Places places;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (of_point[k].size() < 2) of_point[k].clear();  // the point itself
    for (const Vec3 place : of_point[k]) {
      places.sensors.position.push_back(place);
      places.sensors.normal.push_back(pixels.points.sensors.normal[chosen[k]]);
      places.point.push_back(chosen[k]);
    }
    places.first.push_back(places.sensors.size());
  }
  return places;
}

}  // namespace

std::vector<std::uint32_t> points_on_edges(const ShadingPoints& points,
                                           const SensorIlluminance& light, double tolerance) {
  const double floor_lux = kDim * mean_lux(light);
  std::vector<std::uint8_t> is_edge(points.sensors.size());
  parallel_for(is_edge.size(), 1024, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const double own = light.reflected_lux[i];
      points.for_each_near(i, 1, [&](std::size_t k, double) {
        const double other = light.reflected_lux[k];
        const double allowed = tolerance * std::max({own, other, floor_lux});
        if (std::abs(own - other) > allowed) is_edge[i] = 1;
      });
    }
  });
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < is_edge.size(); ++i) {
    if (is_edge[i] != 0) found.push_back(i);
  }
  return found;
}

void take_means_of_rays(const PixelRays& pixels, std::span<const std::uint32_t> chosen,
                        const PlaceLightFinder& find, SensorIlluminance& light) {
  const Places places = places_of(pixels, chosen);
  if (places.sensors.size() == 0) return;
  SensorIlluminance found(places.sensors.size());
  find(places.sensors, places.point, found);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const std::size_t begin = places.first[k], end = places.first[k + 1];
    if (begin == end) continue;
    Rgb sum{};
    double squares = 0.0;
    for (std::size_t p = begin; p < end; ++p) {
      sum = sum + found.reflected_rgb[p];
      squares += found.error_lux[p] * found.error_lux[p];
    }
    const auto count = static_cast<double>(end - begin);
    light.set_reflected(chosen[k], (1.0 / count) * sum);
    light.error_lux[chosen[k]] = std::sqrt(squares) / count;
  }
}

}  // namespace tenku
