/// Sensor positions from a file, as users of Radiance have them.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/vec3.h"

namespace tenku {

/// Sensors as the file gives them.
///
/// Frame    the coordinates of the scene file; normals of any length but zero.
/// Shape    both arrays [sensor].
struct SensorPoints {
  std::vector<Vec3> position, normal;

  std::size_t size() const { return position.size(); }
};

/// Reads `x y z nx ny nz` a line, separated by blanks, tabs or commas; `#` begins a comment.
///
/// @param path  `-` for standard input
/// @throws InputError  naming the line: not six numbers, a number that is not finite, a normal of
///                     length zero; no sensors at all; a file that cannot be read
SensorPoints read_sensor_file(const std::filesystem::path& path);

/// The same from text; `name` stands for the file in messages.
SensorPoints sensors_from_text(std::string_view text, std::string_view name);

}  // namespace tenku
