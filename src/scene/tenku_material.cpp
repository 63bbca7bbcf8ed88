#include "scene/tenku_material.h"

#include <algorithm>
#include <string>

#include "scene/json_source.h"

namespace tenku {
namespace {

bool is_share(double value) { return value >= 0.0 && value <= 1.0; }

Material material_of(JsonElement element, const JsonSource& source) {
  const auto colour = [&](const char* name, Rgb otherwise) {
    const auto found = JsonSource::member(element, name);
    if (!found) return otherwise;
    const Vec3 rgb = source.point(*found, name);
    return Rgb{rgb.x, rgb.y, rgb.z};
  };
  Material m;
  m.name = source.text(element, "name");
  m.reflectance = colour("reflectance", m.reflectance);
  m.mirror = source.number(element, "mirror", 0.0);
  m.mirror_tint = colour("mirror_tint", m.mirror_tint);
  m.mirror_index = source.number(element, "mirror_index", 0.0);
  m.index = source.number(element, "index", 0.0);
  m.transmittance = source.number(element, "transmittance", 0.0);
  m.emission_lm_m2 = colour("emission_lm_m2", {});
  bool is_possible = is_share(m.mirror) && is_share(m.transmittance) &&
                     (m.index == 0.0 || m.index >= 1.0) &&
                     (m.mirror_index == 0.0 || m.mirror_index >= 1.0);
  for (const double channel : {m.reflectance.r, m.reflectance.g, m.reflectance.b}) {
    is_possible &= channel >= 0.0 && channel < 1.0;
  }
  for (const Rgb positive : {m.mirror_tint, m.emission_lm_m2}) {
    is_possible &= std::min({positive.r, positive.g, positive.b}) >= 0.0;
  }
  if (!is_possible) source.refuse("a number of 'tenku_material' is outside what is possible");
  return m;
}

bool is_same(const Material& a, const Material& b) {
  return a.name == b.name && a.reflectance == b.reflectance && a.mirror == b.mirror &&
         a.mirror_tint == b.mirror_tint && a.mirror_index == b.mirror_index && a.index == b.index &&
         a.transmittance == b.transmittance && a.emission_lm_m2 == b.emission_lm_m2;
}

}  // namespace

std::uint32_t tenku_material(simdjson::dom::element semantic_surface, RawScene& raw,
                             const CityJsonPlace& place) {
  const auto found = JsonSource::member(semantic_surface, "tenku_material");
  if (!found) return kNone;
  std::string where = place.file;
  if (!place.object.empty()) where.append(": object '").append(place.object).append("'");
  const Material material = material_of(*found, JsonSource(where));
  // Few are in use, and most often the last again; one that comes twice does no harm.
  constexpr std::size_t kLookedBack = 256;
  auto& known = raw.file_materials;
  const std::size_t first = known.size() - std::min(known.size(), kLookedBack);
  for (std::size_t k = known.size(); k-- > first;) {
    if (is_same(known[k].material, material)) return static_cast<std::uint32_t>(k);
  }
  known.push_back({material, true});
  return static_cast<std::uint32_t>(known.size() - 1);
}

}  // namespace tenku
