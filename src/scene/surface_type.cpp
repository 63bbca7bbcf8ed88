#include "scene/surface_type.h"

#include <array>
#include <cstddef>

namespace tenku {
namespace {

constexpr std::array<std::string_view, kSurfaceTypes> kNames{
    "unknown", "ground", "wall", "roof",  "ceiling",   "floor",
    "window",  "door",   "road", "water", "vegetation"};

}  // namespace

std::string_view name_of(SurfaceType type) { return kNames[static_cast<std::size_t>(type)]; }

std::optional<SurfaceType> surface_type_named(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) return static_cast<SurfaceType>(i);
  }
  return std::nullopt;
}

}  // namespace tenku
