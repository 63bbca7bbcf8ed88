#include "study/surface_results.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "output/gltf_writer.h"
#include "scene/cityjson_writer.h"
#include "study/illuminance_field.h"
#include "study/surface_means.h"
#include "view/false_colour.h"
#include "view/value_scale.h"

namespace tenku {
namespace {

std::vector<CityJsonAttribute> attributes(const std::vector<LuxValues>& means) {
  std::vector<CityJsonAttribute> all;
  for (std::size_t k = 0; k < kLuxValues; ++k) {
    CityJsonAttribute one{kLuxNames[k], {}};
    for (const LuxValues& values : means) one.values.push_back(values[k]);
    all.push_back(std::move(one));
  }
  return all;
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
  const SurfaceMeans means = surface_means(lit.scene(), grid, values);
  return cityjson_of(lit.scene(), attributes(means.of_surfaces), attributes(means.of_objects));
}

std::string glb_of_grid(const LitScene& lit, const SensorGrid& grid,
                        const SensorIlluminance& values) {
  std::vector<double> totals;
  for (std::size_t i = 0; i < values.size(); ++i) totals.push_back(values.total_lux(i));
  const ValueScale scale = round_scale(totals);
  GltfMesh mesh;
  mesh.name = "illuminance";
  for (std::size_t k = 0; k < kLuxValues; ++k) {
    std::string name = std::string("_") + kLuxNames[k];
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
      const LuxValues all = lux_values(values, sensor);
      for (std::size_t k = 0; k < kLuxValues; ++k) {
        mesh.values[k].values.push_back(static_cast<float>(all[k]));
      }
    }
  }
  mesh.extras_json = extras_of(lit, scale).dump();
  return glb_of(mesh);
}

}  // namespace tenku
