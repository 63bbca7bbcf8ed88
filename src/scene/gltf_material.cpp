#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/gltf_scene.h"

namespace tenku {
namespace {

constexpr double kMostReflectance = 0.9;  // as that of OBJ's materials
constexpr double kUsualIndex = 1.5;       // KHR_materials_ior

Rgb clamped(Rgb c, double most) {
  return {std::clamp(c.r, 0.0, most), std::clamp(c.g, 0.0, most), std::clamp(c.b, 0.0, most)};
}

struct BaseColour {
  Rgb colour{1.0, 1.0, 1.0};
  double alpha = 1.0;
  bool is_given = false;
};

BaseColour base_colour_of(JsonElement pbr, const JsonSource& source) {
  BaseColour base;
  const auto factor = JsonSource::member(pbr, "baseColorFactor");
  if (!factor) return base;
  const auto rgba = source.numbers(*factor, 4, "baseColorFactor");
  base.colour = {rgba[0], rgba[1], rgba[2]};
  base.alpha = std::clamp(rgba[3], 0.0, 1.0);
  base.is_given = true;
  return base;
}

std::optional<JsonElement> extension_of(JsonElement material, const char* name) {
  const auto all = JsonSource::member(material, "extensions");
  return all ? JsonSource::member(*all, name) : std::nullopt;
}

/// Share of light that passes at normal incidence, by transmission or by blending.
double transmittance_of(JsonElement material, const BaseColour& base, const JsonSource& source) {
  if (const auto through = extension_of(material, "KHR_materials_transmission")) {
    const auto ior = extension_of(material, "KHR_materials_ior");
    const double n = std::max(1.0, ior ? source.number(*ior, "ior", kUsualIndex) : kUsualIndex);
    const double mirrored = std::pow((n - 1.0) / (n + 1.0), 2);
    const double factor = std::clamp(source.number(*through, "transmissionFactor", 0.0), 0.0, 1.0);
    return factor * (1.0 - mirrored) * luminance_of(clamped(base.colour, 1.0));
  }
  return source.text(material, "alphaMode") == "BLEND" ? 1.0 - base.alpha : 0.0;
}

Rgb emission_of(JsonElement material, const JsonSource& source) {
  const auto factor = JsonSource::member(material, "emissiveFactor");
  if (!factor) return {};
  const Vec3 rgb = source.point(*factor, "emissiveFactor");
  const auto strong = extension_of(material, "KHR_materials_emissive_strength");
  const double strength = strong ? source.number(*strong, "emissiveStrength", 1.0) : 1.0;
  if (!(std::min({rgb.x, rgb.y, rgb.z, strength}) >= 0.0)) {
    source.refuse("a material has an emission below 0");
  }
  return std::numbers::pi * strength * Rgb{rgb.x, rgb.y, rgb.z};
}

void set_surface(Material& material, const BaseColour& base, JsonElement pbr,
                 const JsonSource& source, RawScene& raw) {
  const double metallic = std::clamp(source.number(pbr, "metallicFactor", 1.0), 0.0, 1.0);
  const bool is_smooth = !(source.number(pbr, "roughnessFactor", 1.0) > 0.0);
  const double passed = material.transmittance;
  const Rgb colour = clamped(base.colour, 1.0);
  Rgb diffuse = (1.0 - passed) * colour;
  if (is_smooth && metallic > 0.0) {
    const Rgb mirrored = (metallic * (1.0 - passed)) * colour;
    material.mirror = luminance_of(mirrored);
    if (material.mirror > 0.0) material.mirror_tint = (1.0 / material.mirror) * mirrored;
    diffuse = (1.0 - metallic) * diffuse;
  }
  material.reflectance = clamped(diffuse, kMostReflectance);
  if (material.reflectance == diffuse && colour == base.colour) return;
  raw.findings.add({"reflectance_clamped", Severity::Note, "", source.place(),
                    "the base colour of material '" + material.name + "' is outside 0 to 0.9",
                    "brought into that range; --materials can say better"});
}

}  // namespace

RawScene::FileMaterial gltf_material(JsonElement element, const JsonSource& source, RawScene& raw) {
  RawScene::FileMaterial entry;
  Material& material = entry.material;
  material.name = source.text(element, "name");
  const auto pbr = JsonSource::member(element, "pbrMetallicRoughness");
  const BaseColour base = pbr ? base_colour_of(*pbr, source) : BaseColour{};
  const bool is_textured = pbr && JsonSource::member(*pbr, "baseColorTexture").has_value();
  material.transmittance = transmittance_of(element, base, source);
  material.emission_lm_m2 = emission_of(element, source);
  const double emitted = luminance_of(material.emission_lm_m2);
  entry.given = base.is_given || material.transmittance > 0.0 || emitted > 0.0;
  if (is_textured) {
    raw.findings.add({"texture_ignored", Severity::Note, "", source.place(),
                      "textures are not read", "the plain base colour is used, if one is given"});
    // White under a picture says nothing.
    if (base.colour == Rgb{1.0, 1.0, 1.0} && material.transmittance == 0.0 && emitted == 0.0) {
      entry.given = false;
    }
  }
  if (!entry.given) return entry;
  if (emitted > 0.0) {
    raw.findings.add({"two_sided_lamp", Severity::Note, "", source.place(),
                      "lamps shine to the front alone in glTF", "they shine to both sides here"});
  }
  if (base.is_given) set_surface(material, base, *pbr, source, raw);
  return entry;
}

}  // namespace tenku
