/// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace tenku {

/// A file that is written aside and given its final name when it is complete.
///
/// Whoever writes uses `path()`, which has the final file's extension; `commit` flushes it to
/// the device and renames it. Without `commit` the destructor removes it.
class AtomicFile {
 public:
  /// @throws InputError if the folder of `final_path` does not exist or `final_path` is a folder
  explicit AtomicFile(std::filesystem::path final_path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& path() const { return temporary_; }

  /// @throws ResourceError if the file is not there, or cannot be flushed or renamed
  void commit();

 private:
  std::filesystem::path final_, temporary_;
  bool committed_ = false;
};

/// Tells before a long calculation whether its result could be written to `path`; `-` always can.
/// @throws InputError if the folder does not exist or refuses files, or `path` is a folder
void check_can_write(const std::filesystem::path& path);

/// Writes `bytes` to `path`, or to standard output if `path` is `-`.
/// @throws InputError, ResourceError as AtomicFile does
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace tenku
