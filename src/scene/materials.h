/// Which surface has which material.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "scene/raw_scene.h"

namespace tenku {

/// Material of a surface about which nothing but its type is known.
///
/// Source   docs/materials.md has the values and where each comes from.
Material default_material(SurfaceType type);

/// Named materials of a TOML file; `cli.md` has the keys.
/// @throws InputError  naming file and line: not TOML, a key that is not known, a value out of
/// range
std::map<std::string, Material> read_materials(const std::filesystem::path& path);

/// Sets the scene's materials and the material of each surface. The most specific name wins: object
/// id (which also holds for the parts of the object), material of the file, group, surface type. An
/// id whose material is no glass leaves windows as they are, but for an object of windows alone.
/// A name that nothing bears is a finding.
void assign_materials(RawScene& raw, const std::map<std::string, Material>& named);

}  // namespace tenku
