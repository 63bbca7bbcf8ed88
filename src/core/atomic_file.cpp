#include "core/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>

#include "core/error.h"

namespace tenku {
namespace fs = std::filesystem;

namespace {

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

void check_place(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_directory(folder_of(path), ignored)) {
    throw InputError("cannot write " + path.string() + ": there is no folder " +
                     folder_of(path).string());
  }
  if (fs::is_directory(path, ignored)) {
    throw InputError("cannot write " + path.string() + ": it is a folder");
  }
}

}  // namespace

AtomicFile::AtomicFile(fs::path final_path) : final_(std::move(final_path)) {
  check_place(final_);
  temporary_ = folder_of(final_) /
               (".partial-" + std::to_string(getpid()) + "-" + final_.filename().string());
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!committed_) fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  const int file = ::open(temporary_.c_str(), O_RDONLY);
  if (file < 0 || ::fsync(file) != 0) {
    const std::string reason = std::strerror(errno);
    if (file >= 0) ::close(file);
    throw ResourceError("cannot write " + final_.string() + ": " + reason);
  }
  ::close(file);
  std::error_code error;
  fs::rename(temporary_, final_, error);
  if (error) throw ResourceError("cannot write " + final_.string() + ": " + error.message());
  committed_ = true;
}

namespace {

void write_all(std::FILE* file, std::string_view bytes, const std::string& name) {
  const bool ok = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  if (!ok || std::fflush(file) != 0) {
    throw ResourceError("cannot write " + name + ": " + std::strerror(errno));
  }
}

}  // namespace

void check_can_write(const fs::path& path) {
  if (path == "-") return;
  check_place(path);
  if (::access(folder_of(path).c_str(), W_OK) != 0) {
    throw InputError("cannot write " + path.string() + ": " + std::strerror(errno));
  }
}

void write_whole_file(const fs::path& path, std::string_view bytes) {
  if (path == "-") return write_all(stdout, bytes, "standard output");
  AtomicFile target(path);
  std::FILE* file = std::fopen(target.path().c_str(), "wb");
  if (file == nullptr) {
    throw ResourceError("cannot write " + path.string() + ": " + std::strerror(errno));
  }
  try {
    write_all(file, bytes, path.string());
  } catch (...) {
    std::fclose(file);
    throw;
  }
  if (std::fclose(file) != 0) {
    throw ResourceError("cannot write " + path.string() + ": " + std::strerror(errno));
  }
  target.commit();
}

}  // namespace tenku
