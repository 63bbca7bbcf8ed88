/// Sensor positions from a file, as users of Radiance have them.
#pragma once

#include <filesystem>
#include <string_view>

#include "illuminance/sensor.h"

namespace tenku {

/// Reads `x y z nx ny nz` a line, separated by blanks, tabs or commas; `#` begins a comment.
///
/// @param path  `-` for standard input
/// @return      in the coordinates of the scene file; normals of any length but zero
/// @throws InputError  naming the line: not six numbers, a number that is not finite, a normal of
///                     length zero; no sensors at all; a file that cannot be read
Sensors read_sensor_file(const std::filesystem::path& path);

/// The same from text; `name` stands for the file in messages.
Sensors sensors_from_text(std::string_view text, std::string_view name);

}  // namespace tenku
