#include "illuminance/light_method.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/suggest.h"

namespace tenku {
namespace {

/// The value beside a name.
template <class Value, std::size_t count>
Value named(std::string_view name, const std::array<std::pair<std::string_view, Value>, count>& all,
            const char* what) {
  std::vector<std::string_view> known;
  for (const auto& [one, value] : all) {
    if (one == name) return value;
    known.push_back(one);
  }
  throw InputError("there is no " + std::string(what) + " '" + std::string(name) + "'" +
                   suggestion(name, known));
}

}  // namespace

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

}  // namespace tenku
