/// Puts a scene on the map: from what file and options say to a frame and a georeference.
#pragma once

#include "scene/raw_scene.h"

namespace tenku {

struct Crs;

/// Whether a point in degrees is latitude, longitude rather than longitude, latitude.
/// @throws InputError if by neither it lies where the reference system is used
bool is_latitude_first(const Crs& crs, Vec3 at, bool has_registry_axes);

/// Chooses the local origin and sets `frame`, `georeference` and `extent` of the scene, and turns
/// its vertices into local metres.
///
/// The origin is the middle of the extent at height 0 where there is a CRS; else the file's own,
/// unless everything lies more than 20 km from it.
///
/// @throws InputError if an option contradicts the file, or the CRS of the options is unusable
void place_scene(RawScene& raw, const ReadOptions& options);

}  // namespace tenku
