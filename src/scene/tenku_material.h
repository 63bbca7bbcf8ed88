/// Materials on semantic surfaces of CityJSON, our own. Private to this module.
#pragma once

#include <simdjson.h>

#include <cstdint>

#include "scene/cityjson_geometry.h"
#include "scene/raw_scene.h"

namespace tenku {

/// Index into `RawScene::file_materials` of the attribute `tenku_material` of a semantic surface;
/// kNone if it has none.
/// @throws InputError if a number of it is outside what is possible
std::uint32_t tenku_material(simdjson::dom::element semantic_surface, RawScene& raw,
                             const CityJsonPlace& place);

}  // namespace tenku
