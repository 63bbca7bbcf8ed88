/// Readers of plain meshes: PLY, STL and glTF.
#pragma once

#include <filesystem>

#include "core/progress.h"
#include "scene/raw_scene.h"

namespace tenku {

/// Reads the vertices and faces of a PLY file, ASCII or binary of either byte order.
///
/// Source   G. Turk, "The PLY Polygon File Format", Stanford University, 1994.
/// @throws InputError  naming file and element or line, and as `read_input_file`
RawScene read_ply(const std::filesystem::path& path, Progress& progress);

/// Reads the triangles of an STL file, ASCII or binary. Each `solid` of an ASCII file is an object.
/// Normals are those of the vertices' order, whatever the file says.
///
/// Source   3D Systems, "StereoLithography Interface Specification", 1989.
/// @throws InputError  naming file and triangle or line, and as `read_input_file`
RawScene read_stl(const std::filesystem::path& path, Progress& progress);

/// Reads the triangles of a glTF 2.0 file, `.gltf` or `.glb`, also packed by Draco. Each node with
/// a mesh is an object, or each feature of EXT_structural_metadata with an id. Coordinates are y
/// up, as the standard has them.
///
/// Source   The Khronos Group, "glTF 2.0 Specification" (2021).
/// @throws InputError  naming the file and what is wrong in it, and as `read_input_file`
RawScene read_gltf(const std::filesystem::path& path, Progress& progress);

}  // namespace tenku
