/// Whole files in memory, unpacked if they are packed.
#pragma once

#include <filesystem>
#include <string>

namespace tenku {

/// Bytes of a file; those of a gzip file (told by its first bytes) unpacked.
/// @throws InputError if it is absent, a folder, not readable, empty, or a damaged gzip file
std::string read_input_file(const std::filesystem::path& path);

}  // namespace tenku
