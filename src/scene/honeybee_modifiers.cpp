#include "scene/honeybee_modifiers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "core/error.h"
#include "scene/radiance_reader.h"
#include "scene/text_cursor.h"

namespace tenku {
namespace {

/// What honeybee-radiance gives where nothing is said.
struct GenericModifier {
  std::string_view set, key, name;
  bool is_glass;
  double value;  ///< reflectance, or transmissivity of glass
};
constexpr double kWindow = 0.6975761815384331;       // transmittance 0.64
constexpr double kInnerWindow = 0.9584154328610596;  // transmittance 0.88
constexpr std::array<GenericModifier, 15> kGeneric{{
    {"wall_set", "exterior_modifier", "generic_wall_0.50", false, 0.5},
    {"wall_set", "interior_modifier", "generic_wall_0.50", false, 0.5},
    {"floor_set", "exterior_modifier", "generic_floor_0.20", false, 0.2},
    {"floor_set", "interior_modifier", "generic_floor_0.20", false, 0.2},
    {"roof_ceiling_set", "exterior_modifier", "generic_ceiling_0.80", false, 0.8},
    {"roof_ceiling_set", "interior_modifier", "generic_ceiling_0.80", false, 0.8},
    {"aperture_set", "interior_modifier", "generic_interior_window_vis_0.88", true, kInnerWindow},
    {"door_set", "exterior_modifier", "generic_opaque_door_0.50", false, 0.5},
    {"door_set", "interior_modifier", "generic_opaque_door_0.50", false, 0.5},
    {"door_set", "overhead_modifier", "generic_opaque_door_0.50", false, 0.5},
    {"door_set", "interior_glass_modifier", "generic_interior_window_vis_0.88", true, kInnerWindow},
    {"door_set", "exterior_glass_modifier", "generic_exterior_window_vis_0.64", true, kWindow},
    {"shade_set", "interior_modifier", "generic_interior_shade_0.50", false, 0.5},
    {"shade_set", "exterior_modifier", "generic_exterior_shade_0.35", false, 0.35},
    {"shade_set", "context", "generic_context_0.20", false, 0.2},
}};
constexpr GenericModifier kGenericWindow{"aperture_set", "", "generic_exterior_window_vis_0.64",
                                         true, kWindow};

std::string in_small_letters(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The numbers in the order in which Radiance has them.
std::vector<double> numbers_of(JsonElement modifier, const std::string& type,
                               const JsonSource& source) {
  const auto colour = [&](const std::string& what) {
    std::vector<double> rgb;
    for (const char* channel : {"r_", "g_", "b_"}) {
      rgb.push_back(source.number(modifier, std::string(channel).append(what), 0.0));
    }
    return rgb;
  };
  if (type == "plastic" || type == "metal") {
    std::vector<double> numbers = colour("reflectance");
    numbers.push_back(source.number(modifier, "specularity", 0.0));
    numbers.push_back(source.number(modifier, "roughness", 0.0));
    return numbers;
  }
  if (type == "glass") {
    std::vector<double> numbers = colour("transmissivity");
    if (JsonSource::member(modifier, "refraction_index")) {
      numbers.push_back(source.number(modifier, "refraction_index", 0.0));
    }
    return numbers;
  }
  if (type == "light" || type == "glow") return colour("emittance");
  return type == "mirror" ? colour("reflectance") : std::vector<double>{};
}

}  // namespace

HoneybeeModifiers::HoneybeeModifiers(JsonElement model, const JsonSource& source, RawScene& raw)
    : source_(source), raw_(raw) {
  const auto properties = JsonSource::member(model, "properties");
  const auto radiance = properties ? JsonSource::member(*properties, "radiance") : std::nullopt;
  if (!radiance) return;
  for (const JsonElement modifier : source.list(*radiance, "modifiers")) add(modifier);
  for (const JsonElement set : source.list(*radiance, "modifier_sets")) {
    sets_.insert_or_assign(source.text(set, "identifier"), set);
  }
  const auto all = JsonSource::member(*radiance, "global_modifier_set");
  if (!all) return;
  if (all->is_string()) {
    model_set_ = source.text(*radiance, "global_modifier_set");
    return;
  }
  for (const JsonElement modifier : source.list(*all, "modifiers")) add(modifier);
  model_set_ = "\n";  // no identifier
  sets_.insert_or_assign(model_set_, *all);
}

std::uint32_t HoneybeeModifiers::add(JsonElement modifier) {
  const std::string id = source_.text(modifier, "identifier");
  const std::string type = in_small_letters(source_.text(modifier, "type"));
  RawScene::FileMaterial entry;
  try {
    const auto material = radiance_material(type, numbers_of(modifier, type, source_));
    entry = {material.value_or(Material{}), material.has_value()};
  } catch (const InputError& error) {
    source_.refuse("modifier " + tenku::quoted(id) + ": " + error.what());
  }
  if (!entry.given) {
    raw_.findings.add({"unknown_material", Severity::Note, "", tenku::quoted(id),
                       tenku::quoted(type) + " has no counterpart here",
                       "surfaces take the material of their type; --materials can say better"});
  } else if (luminance_of(entry.material.emission_lm_m2) > 0.0) {
    raw_.findings.add({"two_sided_lamp", Severity::Note, "", tenku::quoted(id),
                       "lamps shine to the front alone in Radiance",
                       "they shine to both sides here"});
  }
  entry.material.name = id;
  raw_.file_materials.push_back(entry);
  const auto index = static_cast<std::uint32_t>(raw_.file_materials.size() - 1);
  modifiers_.insert_or_assign(id, index);
  return index;
}

/// A modifier written out, or the identifier of one.
std::uint32_t HoneybeeModifiers::named(JsonElement modifier) {
  std::string_view id;
  if (modifier.get(id) != simdjson::SUCCESS) return add(modifier);
  const auto known = modifiers_.find(std::string(id));
  if (known != modifiers_.end()) return known->second;
  raw_.findings.add({"missing_modifier", Severity::Warning, "", tenku::quoted(id),
                     "a modifier is named that the model does not have",
                     "surfaces take the material of their type; --materials can say better"});
  RawScene::FileMaterial entry;
  entry.material.name = id;
  raw_.file_materials.push_back(entry);
  const auto index = static_cast<std::uint32_t>(raw_.file_materials.size() - 1);
  modifiers_.emplace(id, index);
  return index;
}

std::uint32_t HoneybeeModifiers::in_set(const std::string& set, ModifierSlot slot) {
  const auto found = sets_.find(set);
  if (set.empty() || found == sets_.end()) return kNone;
  const auto part = JsonSource::member(found->second, slot.set);
  const auto modifier = part ? JsonSource::member(*part, slot.key) : std::nullopt;
  return modifier ? named(*modifier) : kNone;
}

std::uint32_t HoneybeeModifiers::generic(ModifierSlot slot) {
  const auto* row = std::find_if(kGeneric.begin(), kGeneric.end(), [&](const auto& r) {
    return r.set == slot.set && r.key == slot.key;
  });
  const GenericModifier& generic = row == kGeneric.end() ? kGenericWindow : *row;
  const auto known = modifiers_.find(std::string(generic.name));
  if (known != modifiers_.end()) return known->second;
  const double v = generic.value;
  RawScene::FileMaterial entry;
  entry.material = generic.is_glass ? *radiance_material("glass", {v, v, v})
                                    : *radiance_material("plastic", {v, v, v, 0.0, 0.0});
  entry.material.name = generic.name;
  entry.given = true;
  raw_.file_materials.push_back(entry);
  const auto index = static_cast<std::uint32_t>(raw_.file_materials.size() - 1);
  modifiers_.emplace(generic.name, index);
  return index;
}

std::uint32_t HoneybeeModifiers::of(JsonElement object, const std::string& room_set,
                                    ModifierSlot slot) {
  const auto properties = JsonSource::member(object, "properties");
  const auto radiance = properties ? JsonSource::member(*properties, "radiance") : std::nullopt;
  const auto own = radiance ? JsonSource::member(*radiance, "modifier") : std::nullopt;
  if (own) return named(*own);
  for (const std::string& set : {room_set, model_set_}) {
    const std::uint32_t modifier = in_set(set, slot);
    if (modifier != kNone) return modifier;
  }
  return generic(slot);
}

}  // namespace tenku
