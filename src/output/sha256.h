/// Fingerprints of files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tenku {

/// SHA-256 of `bytes`, 64 hexadecimal digits in lower case.
///
/// Source   FIPS 180-4.
std::string sha256_of(std::string_view bytes);

/// SHA-256 of the contents of a file.
/// @throws InputError if it cannot be read
std::string sha256_of_file(const std::filesystem::path& path);

/// SHA-256 of a file; of a folder, that of the list that `sha256sum` makes of the files in it, by
/// name.
/// @throws InputError if a file cannot be read
std::string sha256_of_input(const std::filesystem::path& path);

}  // namespace tenku
