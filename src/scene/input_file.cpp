#include "scene/input_file.h"

#include <zlib.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/error.h"
#include "core/handle.h"

namespace tenku {
namespace fs = std::filesystem;
namespace {

// Guards against a small file that unpacks without end; simdjson reads no more either.
constexpr std::size_t kMostBytes = std::size_t{4} << 30U;

struct GzipClose {
  void operator()(gzFile_s* file) const noexcept { gzclose(file); }
};

void refuse_unreadable(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) {
    throw InputError("there is no file " + path.string());
  }
  if (fs::is_directory(status)) throw InputError(path.string() + " is a folder, not a file");
}

std::size_t first_guess(const fs::path& path) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  return error ? std::size_t{1} << 20U : static_cast<std::size_t>(size) + 1;
}

bool is_gzip(const fs::path& path) {
  const Handle<std::FILE, &std::fclose> file(std::fopen(path.c_str(), "rb"));
  if (!file) throw InputError("cannot read " + path.string() + ": " + std::strerror(errno));
  unsigned char magic[2] = {0, 0};
  return std::fread(magic, 1, 2, file.get()) == 2 && magic[0] == 0x1f && magic[1] == 0x8b;
}

}  // namespace

std::string read_input_file(const fs::path& path) {
  refuse_unreadable(path);
  const bool packed = is_gzip(path);
  const std::unique_ptr<gzFile_s, GzipClose> file(gzopen(path.c_str(), "rb"));
  if (!file) throw InputError("cannot read " + path.string() + ": " + std::strerror(errno));
  gzbuffer(file.get(), 1U << 18U);
  std::string bytes(packed ? 6 * first_guess(path) : first_guess(path), '\0');
  std::size_t used = 0;
  for (;;) {
    if (used == bytes.size()) bytes.resize(2 * used);
    const std::size_t room = std::min<std::size_t>(bytes.size() - used, 1U << 30U);
    const int got = gzread(file.get(), bytes.data() + used, static_cast<unsigned>(room));
    int code = Z_OK;
    const char* reason = gzerror(file.get(), &code);
    if (got < 0 || code == Z_BUF_ERROR) {
      throw InputError(path.string() + " is cut off or damaged: " + reason);
    }
    if (got == 0) break;
    used += static_cast<std::size_t>(got);
    if (used > kMostBytes) throw InputError(path.string() + " is larger than 4 GB unpacked");
  }
  if (used == 0) throw InputError(path.string() + " is empty");
  bytes.resize(used);
  return bytes;
}

}  // namespace tenku
