#include "output/film_writer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

extern char** environ;

namespace tenku {
namespace {

bool is_on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "";
  while (!rest.empty()) {
    const std::size_t end = rest.find(':');
    const std::string folder(rest.substr(0, end));
    if (access((folder + "/" + program).c_str(), X_OK) == 0) return true;
    rest = end == std::string_view::npos ? "" : rest.substr(end + 1);
  }
  return false;
}

std::vector<std::string> ffmpeg_arguments(const std::filesystem::path& file, int width, int height,
                                          double frames_per_s) {
  return {"ffmpeg",
          "-nostdin",
          "-hide_banner",
          "-loglevel",
          "error",
          "-y",
          "-f",
          "rawvideo",
          "-pix_fmt",
          "rgb24",
          "-s",
          fmt::format("{}x{}", width, height),
          "-r",
          fmt::format("{}", frames_per_s),
          "-i",
          "pipe:0",
          "-an",
          "-vf",
          "pad=ceil(iw/2)*2:ceil(ih/2)*2",
          "-c:v",
          "libx264",
          "-crf",
          "17",
          "-pix_fmt",
          "yuv420p",
          "-movflags",
          "+faststart",
          "-f",
          "mp4",
          "file:" + file.string()};
}

/// Starts it with `input` as its standard input, by its arguments and no shell.
pid_t start(std::vector<std::string> arguments, int input) {
  std::vector<char*> pointers;
  for (std::string& a : arguments) pointers.push_back(a.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t program = -1;
  const int error =
      posix_spawnp(&program, pointers.front(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error == 0 ? program : -1;
}

}  // namespace

void check_can_write_films() {
  if (is_on_path("ffmpeg")) return;
  throw InputError(
      "films are made by the program ffmpeg, which is not on the PATH: install it (package "
      "`ffmpeg`), or write frames (--out FOLDER) or a page (--out F.html)");
}

FilmWriter::FilmWriter(const std::filesystem::path& file, int width, int height,
                       double frames_per_s)
    : file_(file), width_(width), height_(height) {
  check_can_write_films();
  // A pair of sockets in place of a pipe: sending to a program that has ended is an error of the
  // call, and no signal.
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    throw ResourceError("no connection to ffmpeg");
  }
  to_program_ = ends[0];
  program_ = start(ffmpeg_arguments(file_.path(), width, height, frames_per_s), ends[1]);
  ::close(ends[1]);
  if (program_ < 0) {
    ::close(to_program_);
    throw ResourceError("ffmpeg cannot be started");
  }
}

FilmWriter::~FilmWriter() {
  if (to_program_ >= 0) ::close(to_program_);
  if (program_ > 0) waitpid(program_, nullptr, 0);
}

void FilmWriter::add(const Image8& picture) {
  expects(picture.width == width_ && picture.height == height_, "all pictures are of one size");
  static_assert(sizeof(Rgb8) == 3, "pixels are sent as they lie");
  const auto* bytes = reinterpret_cast<const char*>(picture.pixels.data());
  std::size_t left = picture.pixels.size() * sizeof(Rgb8);
  while (left > 0) {
    const ssize_t sent = send(to_program_, bytes, left, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) throw ResourceError("ffmpeg ended before the film did");
    bytes += sent, left -= static_cast<std::size_t>(sent);
  }
}

void FilmWriter::close() {
  ::close(to_program_);
  to_program_ = -1;
  int status = 0;
  pid_t ended = -1;
  do {
    ended = waitpid(program_, &status, 0);
  } while (ended < 0 && errno == EINTR);
  program_ = -1;
  if (ended < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw ResourceError("ffmpeg failed to write the film");
  }
  file_.commit();
}

}  // namespace tenku
