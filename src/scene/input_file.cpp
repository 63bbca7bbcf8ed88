#include "scene/input_file.h"

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>

#include "core/error.h"
#include "core/handle.h"

namespace tenku {
namespace fs = std::filesystem;
namespace {

// Guards against a small file that unpacks without end; simdjson reads no more either.
constexpr std::size_t kMostBytes = std::size_t{4} << 30U;

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

/// An open file, unpacked as it is read.
class UnpackedFile {
 public:
  explicit UnpackedFile(const fs::path& path) : path_(path) {
    refuse_unreadable(path);
    is_packed_ = is_gzip(path);
    file_.reset(gzopen(path.c_str(), "rb"));
    if (!file_) throw InputError("cannot read " + path.string() + ": " + std::strerror(errno));
    gzbuffer(file_.get(), 1U << 18U);
  }

  bool is_packed() const { return is_packed_; }

  /// Fills up to `room` bytes and returns how many; 0 at the end.
  std::size_t read(char* bytes, std::size_t room) {
    const int got = gzread(file_.get(), bytes, static_cast<unsigned>(std::min(room, kMostAtOnce)));
    int code = Z_OK;
    const char* reason = gzerror(file_.get(), &code);
    if (got < 0 || code == Z_BUF_ERROR) {
      throw InputError(path_.string() + " is cut off or damaged: " + reason);
    }
    if (got == 0 && read_ == 0) throw InputError(path_.string() + " is empty");
    read_ += static_cast<std::size_t>(got);
    if (read_ > kMostBytes) throw InputError(path_.string() + " is larger than 4 GB unpacked");
    return static_cast<std::size_t>(got);
  }

 private:
  static constexpr std::size_t kMostAtOnce = std::size_t{1} << 30U;

  struct Close {
    void operator()(gzFile_s* file) const noexcept { gzclose(file); }
  };
  fs::path path_;
  std::unique_ptr<gzFile_s, Close> file_;
  bool is_packed_ = false;
  std::size_t read_ = 0;
};

namespace {

/// Where in `text`, from `from` on, the last line ends that is not continued; npos if none does.
std::size_t end_of_lines(std::string_view text, std::size_t from) {
  for (std::size_t end = text.size(); end-- > from;) {
    if (text[end] != '\n') continue;
    const std::size_t last = end > 0 && text[end - 1] == '\r' ? end - 1 : end;
    if (last == 0 || text[last - 1] != '\\') return end;
  }
  return std::string_view::npos;
}

}  // namespace

std::string read_input_file(const fs::path& path) {
  UnpackedFile file(path);
  std::string bytes(file.is_packed() ? 6 * first_guess(path) : first_guess(path), '\0');
  std::size_t used = 0;
  for (;;) {
    if (used == bytes.size()) bytes.resize(2 * used);
    const std::size_t got = file.read(bytes.data() + used, bytes.size() - used);
    if (got == 0) break;
    used += got;
  }
  bytes.resize(used);
  return bytes;
}

void for_each_piece(const fs::path& path, const std::function<void(std::string_view)>& use) {
  constexpr std::size_t kPiece = std::size_t{1} << 18U;
  UnpackedFile file(path);
  std::string piece(kPiece, '\0');
  while (const std::size_t got = file.read(piece.data(), kPiece)) {
    use(std::string_view(piece).substr(0, got));
  }
}

InputLines::InputLines(const fs::path& path) : file_(std::make_unique<UnpackedFile>(path)) {
  unpack_ahead();
}

InputLines::~InputLines() = default;

void InputLines::unpack_ahead() {
  constexpr std::size_t kPiece = std::size_t{1} << 19U;
  ahead_ = std::async(std::launch::async, [file = file_.get()] {
    std::string piece(kPiece, '\0');
    piece.resize(file->read(piece.data(), kPiece));
    return piece;
  });
}

std::string InputLines::next() {
  std::string lines = std::move(begun_);
  begun_.clear();
  while (ahead_.valid()) {
    const std::string piece = ahead_.get();
    if (piece.empty()) break;
    unpack_ahead();
    const std::size_t known = lines.size();
    lines += piece;
    const std::size_t end = end_of_lines(lines, known);
    if (end == std::string_view::npos) continue;
    begun_ = lines.substr(end + 1);
    lines.resize(end + 1);
    break;
  }
  return lines;
}

}  // namespace tenku
