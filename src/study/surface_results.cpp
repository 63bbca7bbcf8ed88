#include "study/surface_results.h"

#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "output/gltf_writer.h"
#include "scene/cityjson_writer.h"
#include "scene/flatten.h"
#include "study/illuminance_field.h"
#include "view/false_colour.h"
#include "view/value_scale.h"

namespace tenku {
namespace {

constexpr std::size_t kValues = 6;
constexpr std::array<const char*, kValues> kNames{"sun_lux",   "sky_lux",   "reflected_lux",
                                                  "total_lux", "error_lux", "sky_view"};

std::array<double, kValues> values_of(const SensorIlluminance& v, std::size_t i) {
  return {v.sun_lux[i],   v.sky_lux[i],   v.reflected_lux[i],
          v.total_lux(i), v.error_lux[i], v.sky_view[i]};
}

/// Sums over parts by their area, and the means of them.
class AreaMeans {
 public:
  explicit AreaMeans(std::size_t count) : sums_(count), areas_(count) {}

  void add(std::size_t at, double area, const std::array<double, kValues>& values) {
    areas_[at] += area;
    for (std::size_t k = 0; k < kValues; ++k) sums_[at][k] += area * values[k];
  }

  std::vector<CityJsonAttribute> attributes() const {
    std::vector<CityJsonAttribute> all;
    for (std::size_t k = 0; k < kValues; ++k) {
      CityJsonAttribute one{kNames[k], {}};
      for (std::size_t i = 0; i < areas_.size(); ++i) {
        one.values.push_back(areas_[i] > 0.0 ? sums_[i][k] / areas_[i]
                                             : std::numeric_limits<double>::quiet_NaN());
      }
      all.push_back(std::move(one));
    }
    return all;
  }

 private:
  std::vector<std::array<double, kValues>> sums_;
  std::vector<double> areas_;
};

double area_of(const std::array<Vec3, 3>& p) {
  return 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
}

/// glTF has colours of vertices in linear light; those of the maps are sRGB.
float linear(std::uint8_t channel) {
  const double c = channel / 255.0;
  return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

nlohmann::ordered_json extras_of(const LitScene& lit, const ValueScale& scale) {
  FieldMesh place;
  add_place(place, lit);
  nlohmann::ordered_json extras{{"colours", "total_lux"},
                                {"colour_map", "viridis"},
                                {"low_lux", scale.low},
                                {"high_lux", scale.high},
                                {"axes", "x east, y up, z south; metres about the local origin"}};
  for (const FieldText& text : place.texts) extras[text.name] = text.values.at(0);
  return extras;
}

}  // namespace

std::string cityjson_of_grid(const LitScene& lit, const SensorGrid& grid,
                             const SensorIlluminance& values) {
  const Scene& scene = lit.scene();
  const std::vector<std::uint32_t> surface = surfaces_of_triangles(scene);
  AreaMeans on_surfaces(scene.surfaces.size()), on_objects(scene.objects.size());
  for (std::size_t part = 0; part < grid.triangle.size(); ++part) {
    const std::uint32_t s = surface[grid.triangle[part]];
    const double third = area_of(grid.corner_point[part]) / 3.0;
    for (const std::uint32_t sensor : grid.corner_sensor[part]) {
      on_surfaces.add(s, third, values_of(values, sensor));
      on_objects.add(scene.surfaces.object[s], third, values_of(values, sensor));
    }
  }
  return cityjson_of(scene, on_surfaces.attributes(), on_objects.attributes());
}

std::string glb_of_grid(const LitScene& lit, const SensorGrid& grid,
                        const SensorIlluminance& values) {
  std::vector<double> totals;
  for (std::size_t i = 0; i < values.size(); ++i) totals.push_back(values.total_lux(i));
  const ValueScale scale = round_scale(totals);
  GltfMesh mesh;
  mesh.name = "illuminance";
  for (std::size_t k = 0; k < kValues; ++k) {
    std::string name = std::string("_") + kNames[k];
    for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    mesh.values.push_back({name, {}});
  }
  for (std::size_t part = 0; part < grid.corner_sensor.size(); ++part) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t sensor = grid.corner_sensor[part][corner];
      mesh.points.push_back(grid.corner_point[part][corner]);
      const Rgb8 colour =
          colour_at(ColourMap::Viridis, scale.position_of(values.total_lux(sensor)));
      mesh.colours.push_back({linear(colour.r), linear(colour.g), linear(colour.b)});
      const auto all = values_of(values, sensor);
      for (std::size_t k = 0; k < kValues; ++k) {
        mesh.values[k].values.push_back(static_cast<float>(all[k]));
      }
    }
  }
  mesh.extras_json = extras_of(lit, scale).dump();
  return glb_of(mesh);
}

}  // namespace tenku
