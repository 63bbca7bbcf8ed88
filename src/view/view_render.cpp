#include "view/view_render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "core/parallel.h"
#include "core/random.h"
#include "view/shading_points.h"

namespace tenku {
namespace {

constexpr int kBlock = 8;  // pixels a side that share reflected light on one surface

/// Averages of skylight over the pixels around, on the same surface.
void smooth_sky(const ShadingPoints& points, SensorIlluminance& light) {
  const std::vector<double> sky = light.sky_lux;
  parallel_for(points.sensors.size(), 1024, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      double sum = 0.0, weight = 0.0;
      points.for_each_near(i, 1, [&](std::size_t k, double w) {
        sum += w * sky[k];
        weight += w;
      });
      light.sky_lux[i] = sum / weight;
    }
  });
}

/// One shading point of every surface in every block of pixels.
std::vector<std::size_t> block_representatives(const ShadingPoints& points) {
  std::unordered_map<std::uint64_t, bool> taken;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < points.sensors.size(); ++i) {
    const auto [column, row] = points.pixel(i);
    const auto block = static_cast<std::uint64_t>(row / kBlock) << 32U |
                       static_cast<std::uint64_t>(column / kBlock);
    if (taken.emplace(mix_bits(points.surface[i] + mix_bits(block)), true).second) {
      chosen.push_back(i);
    }
  }
  return chosen;
}

/// Reflected light of all shading points from that of the representatives.
class ReflectedBlend {
 public:
  ReflectedBlend(const ShadingPoints& points, const std::vector<std::size_t>& chosen,
                 const SensorIlluminance& light)
      : points_(points) {
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      const auto [column, row] = points.pixel(chosen[k]);
      block_[key(points.surface[chosen[k]], column / kBlock, row / kBlock)] = {
          light.reflected_lux[k], light.error_lux[k], column, row};
    }
  }

  struct Value {
    double lux = 0.0, error_lux = 0.0;
  };
  Value at(std::size_t i) const {
    const auto [column, row] = points_.pixel(i);
    double sum = 0.0, error = 0.0, weight = 0.0;
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) {
        const auto found =
            block_.find(key(points_.surface[i], column / kBlock + dx, row / kBlock + dy));
        if (found == block_.end()) continue;
        const Sample& s = found->second;
        const double away = std::hypot(s.column - column, s.row - row) / (2.0 * kBlock);
        const double w = std::exp(-away * away) + 1e-6;
        sum += w * s.lux;
        error += w * s.error_lux;
        weight += w;
      }
    }
    return weight > 0.0 ? Value{sum / weight, error / weight} : Value{};
  }

 private:
  struct Sample {
    double lux, error_lux;
    int column, row;
  };
  static std::uint64_t key(std::uint64_t surface, int column, int row) {
    return mix_bits(surface + mix_bits(static_cast<std::uint64_t>(row + 8) << 32U |
                                       static_cast<std::uint64_t>(column + 8)));
  }
  const ShadingPoints& points_;
  std::unordered_map<std::uint64_t, Sample> block_;
};

IlluminanceOptions options_of(const ViewRequest& request) {
  IlluminanceOptions options;
  options.tolerance_pct = std::min(100.0, 12.0 * request.tolerance_pct);
  options.bounces = 0;
  options.floor_share = 0.01;  // darker is black in any picture
  options.first_slices = 8;    // averaged with the pixels around
  options.seed = request.seed;
  return options;
}

std::uint64_t add_reflected(const ViewRequest& request, const ShadingPoints& points,
                            const RayVisibility& rays, const DaylightSource& source,
                            SensorIlluminance& light, Progress& progress) {
  const std::vector<std::size_t> chosen = block_representatives(points);
  Sensors sensors;
  IlluminanceOptions::KnownDirect direct;
  for (const std::size_t i : chosen) {
    sensors.position.push_back(points.sensors.position[i]);
    sensors.normal.push_back(points.sensors.normal[i]);
    direct.lux.push_back(light.sun_lux[i] + light.sky_lux[i]);
    direct.sky_view.push_back(light.sky_view[i]);
  }
  IlluminanceOptions options = options_of(request);
  options.bounces = request.bounces;
  options.known_direct = &direct;
  // Some twenty representatives are blended in a pixel.
  const IlluminanceResult reflected = illuminate(sensors, rays, source, options, progress);
  const ReflectedBlend blend(points, chosen, reflected.values);
  for (std::size_t i = 0; i < points.sensors.size(); ++i) {
    const auto [lux, error_lux] = blend.at(i);
    light.reflected_lux[i] = lux;
    light.error_lux[i] = std::hypot(light.error_lux[i], error_lux);
  }
  return reflected.rays;
}

/// The sky, and beyond the edge of the scene an open ground of the usual reflectance.
Backdrop backdrop_of(const DaylightSource& source, const SkyModel* sky) {
  constexpr double kGroundReflectance = 0.2;  // as gensky and most codes take it
  return {sky, Rgb::grey(kGroundReflectance * source.unobstructed_lux() / kPi)};
}

void compose(const ShadingPoints& points, const SensorIlluminance& light,
             const std::vector<Material>& materials, RenderedView& result) {
  const std::size_t pixels = result.luminance.pixels.size();
  std::vector<double> weight(pixels, 0.0), lux(pixels, 0.0), error(pixels, 0.0);
  for (std::size_t p = 0; p < pixels; ++p) result.luminance.pixels[p] = points.background[p];
  for (std::size_t i = 0; i < points.sensors.size(); ++i) {
    const std::size_t p = points.pixel_index[i];
    const Material& material = materials[points.material[i]];
    const Rgb leaving = material.emission_lm_m2 + light.total_lux(i) * material.reflectance;
    result.luminance.pixels[p] =
        result.luminance.pixels[p] + (1.0 / kPi) * (points.weight[i] * leaving);
    if (!points.is_seen_directly[i]) continue;
    const double w = points.coverage[i];
    weight[p] += w;
    lux[p] += w * light.total_lux(i);
    error[p] += w * light.error_lux[i];
  }
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t p = 0; p < pixels; ++p) {
    const bool seen = weight[p] > 0.0;
    const double none = std::numeric_limits<double>::quiet_NaN();
    result.illuminance_lux.push_back(seen ? lux[p] / weight[p] : none);
    result.error_lux.push_back(seen ? error[p] / weight[p] : none);
    if (seen) sum += error[p] / weight[p], ++count;
  }
  result.error_mean = count > 0 ? sum / static_cast<double>(count) : 0.0;
}

}  // namespace

RenderedView render_view(const ViewRequest& request, const RayVisibility& rays,
                         const DaylightSource& source, const SkyModel* sky, Progress& progress) {
  const PerspectiveCamera camera(request.view);
  const ShadingPoints points =
      find_shading_points(camera, rays, backdrop_of(source, sky), progress);
  IlluminanceResult light = illuminate(points.sensors, rays, source, options_of(request), progress);
  smooth_sky(points, light.values);
  RenderedView result;
  result.luminance = Image(camera.width(), camera.height());
  result.rays = points.rays + light.rays;
  if (request.bounces > 0 && points.sensors.size() > 0) {
    result.rays += add_reflected(request, points, rays, source, light.values, progress);
  }
  compose(points, light.values, rays.materials(), result);
  return result;
}

}  // namespace tenku
