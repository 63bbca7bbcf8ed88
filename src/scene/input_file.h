/// Files in memory, unpacked if they are packed.
#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <string_view>

namespace tenku {

/// Bytes of a file; those of a gzip file (told by its first bytes) unpacked.
/// @throws InputError if it is absent, a folder, not readable, empty, or a damaged gzip file
std::string read_input_file(const std::filesystem::path& path);

/// Calls `use` on one piece of a file after the other, unpacked; no more than one is in memory.
/// @throws InputError as `read_input_file`
void for_each_piece(const std::filesystem::path& path,
                    const std::function<void(std::string_view)>& use);

class UnpackedFile;

/// The lines of a file in blocks, each unpacked while the one before is made use of.
class InputLines {
 public:
  /// @throws InputError as `read_input_file`
  explicit InputLines(const std::filesystem::path& path);
  ~InputLines();

  /// The next lines; the last of them ends in the block, also if a backslash continues it. Empty at
  /// the end of the file.
  /// @throws InputError as `read_input_file`
  std::string next();

 private:
  void unpack_ahead();

  std::unique_ptr<UnpackedFile> file_;
  std::future<std::string> ahead_;
  std::string begun_;  ///< of a line, at the end of the last block
};

}  // namespace tenku
