/// Reader of Wavefront OBJ with its MTL files.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/progress.h"
#include "scene/raw_scene.h"

namespace tenku {

/// Reads polygons, objects (`o`), groups (`g`) and materials (`usemtl`, `mtllib`).
///
/// Source   Wavefront Technologies, "Advanced Visualizer Manual", appendix B1 (the OBJ format).
/// @param path  MTL files are looked for beside it
/// @throws InputError  naming file and line, and as `read_input_file`
RawScene read_obj(const std::filesystem::path& path, Progress& progress);

/// Type of a surface that has this material or group name, if one of the name's words says so:
/// `Wall_01`, `roof`, `ceil`.
SurfaceType type_by_name(std::string_view name);

/// Materials of an MTL file: `Kd` is the diffuse reflectance, brought down to 0.9 where it is more.
/// Other statements say nothing about reflected light that could be trusted, and are ignored.
/// @throws InputError  naming file and line
void read_mtl(std::string_view text, const std::string& file, RawScene& raw);

}  // namespace tenku
