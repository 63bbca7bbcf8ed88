/// The words of CityGML that its JSON encoding does not have, or that mean no geometry there.
#pragma once

#include <optional>
#include <string_view>

#include "scene/cityjson_types.h"

namespace tenku {

/// What a CityGML element is if it is a city object of its own; nothing for all other elements.
///
/// Source   OGC 08-007r1 (CityGML 1.0), 12-019 (2.0), 20-010 (3.0).
std::optional<CityObjectKind> citygml_object_kind(std::string_view element);

/// Spaces of CityGML 3.0 that divide or mark volumes and are not there to the eye, such as the
/// room that traffic needs. What bounds them may be there.
bool is_logical_space(std::string_view element);

/// What a property that carries geometry says by its name.
struct GeometryProperty {
  enum class Kind { Surfaces, Implicit, PointsOrLines, Auxiliary };
  Kind kind = Kind::Surfaces;
  int lod = 0;  ///< 0 to 4
};

/// `lod2Solid`, `lod0RoofEdge`, `lod1ImplicitRepresentation`: nothing if the name is none of these.
std::optional<GeometryProperty> geometry_property(std::string_view element);

/// Whether a name of a reference system stands for the order of axes in the registry.
bool names_registry_axes(std::string_view crs);

}  // namespace tenku
