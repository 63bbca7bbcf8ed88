/// What comments at the head of an OBJ say about place and axes.
#pragma once

#include <string_view>

#include "scene/raw_scene.h"

namespace tenku {

/// Takes up a comment (without its `#`) if it is one of these forms; ignores it otherwise:
/// - axes of a grid: `x = Easting - 70700.0, y = height, z = -(Northing - 352400.0); EPSG:31255`,
///   the axes in any order, each with an optional constant; anything may follow;
/// - a place, with y up and z to the south: `Longitude: 14.24`, `Latitude: 48.3`,
///   `Elevation: 260.5`, each in a line of its own.
void read_obj_comment(std::string_view comment, RawScene& raw);

}  // namespace tenku
