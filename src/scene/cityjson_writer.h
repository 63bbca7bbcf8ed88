/// Scenes as CityJSON, with or without results on their surfaces.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace tenku {

/// Numbers on surfaces or on objects, by name; NaN where there is none.
struct CityJsonAttribute {
  std::string name;  ///< with the unit: `total_lux`
  std::vector<double> values;
};

/// A scene as CityJSON 2.0: objects, polygons with holes, types as semantic surfaces, and on these
/// the attribute `tenku_material` with what `--materials` or the file gave. `read_scene` reads it
/// back as the same polygons, types and materials; the ground that tenku gave is an object as
/// well. Attributes of surfaces stand on semantic surfaces, those of objects under `attributes`.
///
/// Frame    map coordinates (`Scene::map_frame`): easting, northing, height in the scene's CRS, or
///          longitude, latitude, height; local metres where it has none.
/// Error    coordinates are rounded to 0.01 mm (1e-10 degrees).
/// Source   CityJSON Specifications 2.0.1.
/// @param surface_attributes  values [surface]; without results, polygons of one object, type and
///                            material share a semantic surface
/// @param object_attributes   values [object]
std::string cityjson_of(const Scene& scene,
                        std::span<const CityJsonAttribute> surface_attributes = {},
                        std::span<const CityJsonAttribute> object_attributes = {});

}  // namespace tenku
