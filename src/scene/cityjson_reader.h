/// Reader of CityJSON and CityJSONSeq.
#pragma once

#include <string>

#include "core/progress.h"
#include "scene/raw_scene.h"

namespace tenku {

/// Reads a CityJSON document, or a CityJSONSeq where the first line is a document of its own.
///
/// Source   CityJSON 1.0.3, 1.1.3, 2.0.1 (cityjson.org/specs).
/// @param bytes  the file; capacity is enlarged
/// @param name   of the file, for messages
/// @throws InputError  naming the file and the object or line
RawScene read_cityjson(std::string bytes, const std::string& name, const std::string& building_lod,
                       Progress& progress);

}  // namespace tenku
