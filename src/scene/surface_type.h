/// What a surface is part of: the words of CityGML, merged where light does not care.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace tenku {

enum class SurfaceType : std::uint8_t {
  Unknown,
  Ground,  ///< terrain, land use, ground surfaces of buildings, the ground given by tenku
  Wall,
  Roof,
  Ceiling,  ///< outer and interior ceilings, undersides
  Floor,    ///< outer and interior floors
  Window,
  Door,
  Road,
  Water,
  Vegetation,
};
inline constexpr int kSurfaceTypes = 11;

/// `ground`, `wall`, `roof`, ...: the names in `--grid`, in materials files and in reports.
std::string_view name_of(SurfaceType type);
std::optional<SurfaceType> surface_type_named(std::string_view name);

}  // namespace tenku
