#include "scene/citygml_types.h"

#include <algorithm>
#include <array>

namespace tenku {
namespace {

// Names that mean the same in CityJSON.
constexpr std::array<std::string_view, 31> kShared{
    "Building",
    "BuildingPart",
    "BuildingInstallation",
    "BuildingRoom",
    "BuildingFurniture",
    "BuildingConstructiveElement",
    "Bridge",
    "BridgePart",
    "BridgeInstallation",
    "BridgeConstructionElement",
    "BridgeConstructiveElement",
    "BridgeRoom",
    "BridgeFurniture",
    "Tunnel",
    "TunnelPart",
    "TunnelInstallation",
    "TunnelConstructiveElement",
    "TunnelFurniture",
    "OtherConstruction",
    "Road",
    "Railway",
    "TransportSquare",
    "Waterway",
    "WaterBody",
    "PlantCover",
    "SolitaryVegetationObject",
    "TINRelief",
    "LandUse",
    "CityFurniture",
    "GenericCityObject",
    "CityObjectGroup",
};

struct Synonym {
  std::string_view citygml, cityjson;
};
constexpr std::array<Synonym, 13> kSynonyms{{
    {"Room", "BuildingRoom"},
    {"IntBuildingInstallation", "BuildingInstallation"},
    {"IntBridgeInstallation", "BridgeInstallation"},
    {"IntTunnelInstallation", "TunnelInstallation"},
    {"Track", "Road"},
    {"Square", "TransportSquare"},
    {"TransportationComplex", "Road"},
    {"GenericOccupiedSpace", "GenericCityObject"},
    {"GenericUnoccupiedSpace", "GenericCityObject"},
    {"GenericLogicalSpace", "GenericCityObject"},
    {"GenericThematicSurface", "GenericCityObject"},
    {"Railroad", "Railway"},
    {"TransportationSquare", "TransportSquare"},
}};

constexpr std::array<std::string_view, 7> kLogicalSpaces{
    "TrafficSpace", "AuxiliaryTrafficSpace", "ClearanceSpace",     "HollowSpace",
    "Storey",       "BuildingUnit",          "GenericLogicalSpace"};

template <class List>
bool has(const List& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

GeometryProperty::Kind kind_of(std::string_view name) {
  using Kind = GeometryProperty::Kind;
  if (name.starts_with("ImplicitRepresentation")) return Kind::Implicit;
  if (name.starts_with("TerrainIntersection")) return Kind::Auxiliary;
  for (const std::string_view word : {"Curve", "Point", "Network"}) {
    if (name.find(word) != std::string_view::npos) return Kind::PointsOrLines;
  }
  return Kind::Surfaces;
}

}  // namespace

std::optional<CityObjectKind> citygml_object_kind(std::string_view element) {
  if (has(kShared, element)) return city_object_kind(element);
  for (const Synonym& synonym : kSynonyms) {
    if (synonym.citygml == element) return city_object_kind(synonym.cityjson);
  }
  return std::nullopt;
}

bool is_logical_space(std::string_view element) { return has(kLogicalSpaces, element); }

std::optional<GeometryProperty> geometry_property(std::string_view element) {
  if (element == "tin") return GeometryProperty{};
  constexpr std::size_t kPrefix = 4;  // lod and a digit
  if (element.size() <= kPrefix || !element.starts_with("lod")) return std::nullopt;
  const char digit = element[3], next = element[kPrefix];
  // A name such as lod1HeightType is a word about a level, not geometry of it.
  static constexpr std::array<std::string_view, 14> kNames{"Solid",
                                                           "MultiSolid",
                                                           "Surface",
                                                           "MultiSurface",
                                                           "CompositeSurface",
                                                           "Geometry",
                                                           "FootPrint",
                                                           "RoofEdge",
                                                           "ImplicitRepresentation",
                                                           "TerrainIntersection",
                                                           "MultiCurve",
                                                           "Network",
                                                           "PointCloud",
                                                           "TerrainIntersectionCurve"};
  if (digit < '0' || digit > '4' || next < 'A' || next > 'Z') return std::nullopt;
  const std::string_view name = element.substr(kPrefix);
  const bool is_line = name == "Point" || name == "Curve" || name == "MultiPoint";
  if (!is_line && !has(kNames, name)) return std::nullopt;
  return GeometryProperty{kind_of(name), digit - '0'};
}

bool names_registry_axes(std::string_view crs) {
  return crs.find("/def/crs/") != std::string_view::npos || crs.starts_with("urn:ogc:def:crs");
}

}  // namespace tenku
