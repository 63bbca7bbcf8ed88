#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "scene/radiance_reader.h"

namespace tenku {
namespace {

constexpr double kLumensPerWatt = 179.0;       // Radiance's luminous efficacy of white light
constexpr double kGlassIndex = 1.52;           // of Radiance's glass where none is given
constexpr double kMostReflectance = 0.999999;  // a diffuse reflectance stays below 1

Rgb colour_of(const std::vector<double>& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

void need(const std::vector<double>& numbers, std::size_t count, const std::string& type) {
  if (numbers.size() >= count) return;
  throw InputError("a material of type " + type + " needs " + std::to_string(count) +
                   " numbers, not " + std::to_string(numbers.size()));
}

void need_share(double value, const std::string& type) {
  if (value >= 0.0 && value <= 1.0) return;
  throw InputError("a material of type " + type + " has a share of light outside 0 to 1");
}

void need_shares(Rgb colour, const std::string& type) {
  for (const double channel : {colour.r, colour.g, colour.b}) need_share(channel, type);
}

Rgb below_one(Rgb c) {
  return {std::min(c.r, kMostReflectance), std::min(c.g, kMostReflectance),
          std::min(c.b, kMostReflectance)};
}

/// @param specular  by colour, of what is mirrored
void set_mirror(Material& material, Rgb specular) {
  material.mirror = luminance_of(specular);
  if (material.mirror > 0.0) material.mirror_tint = (1.0 / material.mirror) * specular;
}

/// `plastic` mirrors white, `metal` in its own colour.
Material opaque(const std::string& type, const std::vector<double>& numbers) {
  need(numbers, 5, type);
  const Rgb colour = colour_of(numbers);
  const double specular = numbers[3], roughness = numbers[4];
  need_shares(colour, type);
  need_share(specular, type);
  const Rgb mirrored = specular * (type == "metal" ? colour : Rgb::grey(1.0));
  Material material;
  material.reflectance = (1.0 - specular) * colour;
  if (roughness > 0.0) {
    material.reflectance = material.reflectance + mirrored;
  } else {
    set_mirror(material, mirrored);
  }
  material.reflectance = below_one(material.reflectance);
  return material;
}

Material pane(const std::vector<double>& numbers) {
  need(numbers, 3, "glass");
  const Rgb transmissivity = colour_of(numbers);
  need_shares(transmissivity, "glass");
  const double n = numbers.size() > 3 ? numbers[3] : kGlassIndex;
  if (!(n >= 1.0)) throw InputError("a material of type glass has a refractive index below 1");
  const double r = std::pow((n - 1.0) / (n + 1.0), 2);
  const auto through = [&](double t) { return t * (1.0 - r) * (1.0 - r) / (1.0 - r * r * t * t); };
  Material material;
  material.reflectance = {};
  material.transmittance = luminance_of(
      {through(transmissivity.r), through(transmissivity.g), through(transmissivity.b)});
  return material;
}

Material mirror(const std::vector<double>& numbers) {
  need(numbers, 3, "mirror");
  need_shares(colour_of(numbers), "mirror");
  Material material;
  material.reflectance = {};
  set_mirror(material, colour_of(numbers));
  return material;
}

Material lamp(const std::string& type, const std::vector<double>& numbers) {
  need(numbers, 3, type);
  const Rgb radiance = colour_of(numbers);
  if (!(radiance.r >= 0.0 && radiance.g >= 0.0 && radiance.b >= 0.0)) {
    throw InputError("a material of type " + type + " has a radiance below 0");
  }
  Material material;
  material.reflectance = {};
  material.emission_lm_m2 = kLumensPerWatt * std::numbers::pi * radiance;
  return material;
}

}  // namespace

std::optional<Material> radiance_material(const std::string& type,
                                          const std::vector<double>& numbers) {
  if (type == "plastic" || type == "metal") return opaque(type, numbers);
  if (type == "glass") return pane(numbers);
  if (type == "mirror") return mirror(numbers);
  if (type == "light" || type == "glow") return lamp(type, numbers);
  return std::nullopt;
}

}  // namespace tenku
