/// Reader of CityGML.
#pragma once

#include <filesystem>
#include <string>

#include "core/progress.h"
#include "scene/raw_scene.h"

namespace tenku {

/// Reads the city objects of a CityGML document with their thematic surfaces: polygons, solids,
/// triangulated relief, implicit geometry. Textures, attributes and extensions are passed over.
///
/// Source   OGC 08-007r1 (CityGML 1.0), 12-019 (2.0), 20-010 and 21-006r2 (3.0); GML 3.1.1
/// and 3.2.1
///          for geometry.
/// Frame    coordinates in the order of the file. A reference system named by a URN or URL has the
///          axes of its registry; one named `EPSG:N` has x east, y north.
/// Cost     memory follows what is kept, and the largest single member of the model.
/// @throws InputError  naming file and line, and as `walk_xml`
RawScene read_citygml(const std::filesystem::path& path, const std::string& building_lod,
                      Progress& progress);

}  // namespace tenku
