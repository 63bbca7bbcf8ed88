/// Radiance modifiers of Honeybee models, and which one a face has. Private to this module.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "scene/json_source.h"
#include "scene/raw_scene.h"

namespace tenku {

/// Place in a modifier set: `wall_set` and `exterior_modifier`.
struct ModifierSlot {
  std::string_view set, key;
};

/// The modifiers of a model as materials of the scene.
///
/// Source   Ladybug Tools, "Honeybee Schema": `plastic`, `metal`, `glass`, `mirror`, `light`,
/// `glow`,
///          `ModifierSet`. What no set names has the values of honeybee-radiance's generic set
///          (walls 0.5, floors 0.2, ceilings 0.8, ...), which its samples carry along.
class HoneybeeModifiers {
 public:
  /// @param model  the document
  HoneybeeModifiers(JsonElement model, const JsonSource& source, RawScene& raw);

  /// Index into `RawScene::file_materials` of what an object has: its own modifier, that of the
  /// room's set, of the model's set, or the generic one.
  /// @param room_set  identifier, or empty
  std::uint32_t of(JsonElement object, const std::string& room_set, ModifierSlot slot);

 private:
  std::uint32_t add(JsonElement modifier);
  std::uint32_t named(JsonElement modifier);
  std::uint32_t in_set(const std::string& set, ModifierSlot slot);
  std::uint32_t generic(ModifierSlot slot);

  const JsonSource& source_;
  RawScene& raw_;
  std::unordered_map<std::string, std::uint32_t> modifiers_;
  std::unordered_map<std::string, JsonElement> sets_;
  std::string model_set_;
};

}  // namespace tenku
