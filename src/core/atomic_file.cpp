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

AtomicFile::AtomicFile(fs::path final_path) : final_(std::move(final_path)) {
  const fs::path folder = final_.has_parent_path() ? final_.parent_path() : fs::path(".");
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw InputError("cannot write " + final_.string() + ": there is no folder " +
                     folder.string());
  }
  if (fs::is_directory(final_, ignored)) {
    throw InputError("cannot write " + final_.string() + ": it is a folder");
  }
  temporary_ = folder / (".partial-" + std::to_string(getpid()) + "-" + final_.filename().string());
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
