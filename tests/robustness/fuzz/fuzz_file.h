/// What the fuzzers share: the bytes as a file, and what a reader may say to them.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"

namespace tenku {

/// The file `name` in a folder of this process's own, holding the bytes.
inline std::filesystem::path fuzz_file(const std::string& name, const std::uint8_t* bytes,
                                       std::size_t count) {
  static const std::filesystem::path folder = [] {
    auto path = std::filesystem::temp_directory_path() / ("tenku_fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directories(path);
    return path;
  }();
  std::ofstream(folder / name, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(count));
  return folder / name;
}

/// Calls `read`, which may refuse by InputError and by nothing else.
template <class Read>
int read_or_refuse(const Read& read) {
  try {
    read();
  } catch (const InputError&) {
    return 0;
  }
  return 0;
}

}  // namespace tenku
