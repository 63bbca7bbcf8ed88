#include "illuminance/light_method.h"

#include <array>
#include <utility>

#include "core/named.h"

namespace tenku {

EngineChoice engine_named(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, EngineChoice>, 3> kAll{
      {{"auto", EngineChoice::Auto},
       {"rays", EngineChoice::Rays},
       {"shadow-maps", EngineChoice::ShadowMaps}}};
  return named(name, kAll, "engine");
}

Detail detail_named(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, Detail>, 3> kAll{
      {{"off", Detail::Off}, {"paper", Detail::Paper}, {"budget", Detail::Budget}}};
  return named(name, kAll, "level of detail");
}

Reflection reflection_named(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, Reflection>, 3> kAll{
      {{"auto", Reflection::Auto},
       {"radiosity", Reflection::Radiosity},
       {"paths", Reflection::Paths}}};
  return named(name, kAll, "way of reflected light");
}

}  // namespace tenku
