/// Meshes packed by Draco, as glTF carries them. Private to this module.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/vec3.h"
#include "scene/json_source.h"

namespace tenku {

/// Unpacked triangles: three indices each.
struct DracoMesh {
  std::vector<Vec3> points;
  std::vector<double> features;  ///< [point], or none
  std::vector<std::uint32_t> indices;
};

/// @param positions  id of the attribute with the positions
/// @param features   id of the attribute that tells features apart, if there is one
/// @throws InputError if the bytes are damaged, or lack an attribute
///
/// Source   The Khronos Group, extension KHR_draco_mesh_compression; libdraco does the unpacking.
DracoMesh unpack_draco(std::string_view bytes, std::size_t positions,
                       std::optional<std::size_t> features, const JsonSource& source);

}  // namespace tenku
