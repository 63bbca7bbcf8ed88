#include "study/surface_means.h"

#include <limits>

#include "scene/flatten.h"

namespace tenku {
namespace {

/// Sums over parts by their area, and the means of them.
class AreaMeans {
 public:
  explicit AreaMeans(std::size_t count) : sums_(count), areas_(count) {}

  void add(std::size_t at, double area, const LuxValues& values) {
    areas_[at] += area;
    for (std::size_t k = 0; k < kLuxValues; ++k) sums_[at][k] += area * values[k];
  }

  std::vector<LuxValues> means() && {
    for (std::size_t i = 0; i < areas_.size(); ++i) {
      for (double& sum : sums_[i]) {
        sum = areas_[i] > 0.0 ? sum / areas_[i] : std::numeric_limits<double>::quiet_NaN();
      }
    }
    return std::move(sums_);
  }

 private:
  std::vector<LuxValues> sums_;
  std::vector<double> areas_;
};

double area_of(const std::array<Vec3, 3>& p) {
  return 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
}

}  // namespace

LuxValues lux_values(const SensorIlluminance& v, std::size_t i) {
  return {v.sun_lux[i],   v.sky_lux[i],   v.reflected_lux[i],
          v.total_lux(i), v.error_lux[i], v.sky_view[i]};
}

SurfaceMeans surface_means(const Scene& scene, const SensorGrid& grid,
                           const SensorIlluminance& values) {
  const std::vector<std::uint32_t> surface = surfaces_of_triangles(scene);
  AreaMeans on_surfaces(scene.surfaces.size()), on_objects(scene.objects.size());
  for (std::size_t part = 0; part < grid.triangle.size(); ++part) {
    const std::uint32_t s = surface[grid.triangle[part]];
    const double third = area_of(grid.corner_point[part]) / 3.0;
    for (const std::uint32_t sensor : grid.corner_sensor[part]) {
      on_surfaces.add(s, third, lux_values(values, sensor));
      on_objects.add(scene.surfaces.object[s], third, lux_values(values, sensor));
    }
  }
  return {std::move(on_surfaces).means(), std::move(on_objects).means()};
}

}  // namespace tenku
