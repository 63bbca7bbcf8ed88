#include "scene/cityjson_types.h"

#include <array>

namespace tenku {
namespace {

struct ObjectRow {
  std::string_view name;
  CityObjectKind kind;
};

constexpr CityObjectKind kTerrain{SurfaceType::Ground, false, true, true};
constexpr CityObjectKind kRoad{SurfaceType::Road, false, true, true};
constexpr CityObjectKind kWater{SurfaceType::Water, false, false, true};
constexpr CityObjectKind kPlants{SurfaceType::Vegetation, false, false, true};
constexpr CityObjectKind kOther{SurfaceType::Unknown, false, false, true};
constexpr CityObjectKind kBuilt{SurfaceType::Unknown, true, false, true};

constexpr std::array<ObjectRow, 15> kObjects{{
    {"TINRelief", kTerrain},
    {"LandUse", kTerrain},
    {"Road", kRoad},
    {"Railway", kRoad},
    {"TransportSquare", kRoad},
    {"TransportationSquare", kRoad},
    {"Waterway", kWater},
    {"WaterBody", kWater},
    {"PlantCover", kPlants},
    {"SolitaryVegetationObject", kPlants},
    {"GenericCityObject", kOther},
    {"CityFurniture", kOther},
    {"CityObjectGroup", kOther},
    {"OtherConstruction", kBuilt},
    {"+GenericCityObject", kOther},
}};

struct SurfaceRow {
  std::string_view name;
  SurfaceType type;
};

constexpr std::array<SurfaceRow, 23> kSurfaces{{
    {"RoofSurface", SurfaceType::Roof},
    {"GroundSurface", SurfaceType::Ground},
    {"WallSurface", SurfaceType::Wall},
    {"OuterCeilingSurface", SurfaceType::Ceiling},
    {"OuterFloorSurface", SurfaceType::Floor},
    {"Window", SurfaceType::Window},
    {"WindowSurface", SurfaceType::Window},
    {"Door", SurfaceType::Door},
    {"DoorSurface", SurfaceType::Door},
    {"InteriorWallSurface", SurfaceType::Wall},
    {"CeilingSurface", SurfaceType::Ceiling},
    {"FloorSurface", SurfaceType::Floor},
    {"InteriorCeilingSurface", SurfaceType::Ceiling},
    {"InteriorFloorSurface", SurfaceType::Floor},
    {"WaterSurface", SurfaceType::Water},
    {"WaterGroundSurface", SurfaceType::Ground},
    {"TrafficArea", SurfaceType::Road},
    {"AuxiliaryTrafficArea", SurfaceType::Road},
    {"TransportationMarking", SurfaceType::Road},
    {"TransportationHole", SurfaceType::Road},
    {"RoofEdge", SurfaceType::Roof},
    {"+TenkuSurface", SurfaceType::Unknown},
    {"+TenkuVegetation", SurfaceType::Vegetation},
}};

}  // namespace

CityObjectKind city_object_kind(std::string_view type) {
  for (const ObjectRow& row : kObjects) {
    if (row.name == type) return row.kind;
  }
  for (const std::string_view family : {"Building", "Bridge", "Tunnel"}) {
    if (type.starts_with(family)) return kBuilt;
  }
  return {SurfaceType::Unknown, false, false, false};
}

SemanticKind semantic_kind(std::string_view type) {
  for (const SurfaceRow& row : kSurfaces) {
    if (row.name == type) return {row.type, false, true};
  }
  if (type == "ClosureSurface" || type == "WaterClosureSurface") {
    return {SurfaceType::Unknown, true, true};
  }
  return {SurfaceType::Unknown, false, false};
}

}  // namespace tenku
