/// Triangles with coloured vertices as GLB.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/vec3.h"

namespace tenku {

/// Numbers on the vertices of a mesh.
struct GltfValues {
  std::string name;  ///< begins with an underscore, as glTF has it for attributes of one's own
  std::vector<float> values;
};

/// Triangles, three vertices each.
///
/// Frame    x east, y north, z up; written as glTF's x, z, -y.
/// Units    metres; colours linear Rec. 709 in 0..1.
/// Shape    every array [vertex].
struct GltfMesh {
  std::string name;
  std::vector<Vec3> points;
  std::vector<std::array<float, 3>> colours;
  std::vector<GltfValues> values;
  std::string extras_json;  ///< an object, of the asset; or empty
};

/// A GLB file with one mesh, unlit and seen from both sides.
///
/// Source   The Khronos Group, "glTF 2.0 Specification" (2021), sections 3.7 and 4.4.
/// @throws InputError if an array has the wrong length, or the file would exceed 4 GB
std::string glb_of(const GltfMesh& mesh);

}  // namespace tenku
