/// The words of CityJSON for objects and surfaces, in ours.
#pragma once

#include <optional>
#include <string_view>

#include "scene/surface_type.h"

namespace tenku {

/// What an object of a type is, where its surfaces do not say.
///
/// Source   CityJSON 1.0.3, 1.1.3 and 2.0.1, sections on city objects and semantic surfaces.
struct CityObjectKind {
  SurfaceType type = SurfaceType::Unknown;
  bool is_building = false;  ///< walls and roofs: building, bridge, tunnel and their parts
  bool is_terrain = false;   ///< the ground that a city stands on
  bool is_known = true;
};
CityObjectKind city_object_kind(std::string_view type);

/// What a semantic surface is.
struct SemanticKind {
  SurfaceType type = SurfaceType::Unknown;
  bool is_virtual = false;  ///< closes a volume but is not there: `ClosureSurface`
  bool is_known = true;
};
SemanticKind semantic_kind(std::string_view type);

}  // namespace tenku
