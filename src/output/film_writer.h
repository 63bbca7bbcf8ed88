/// Pictures in a row as one film.
#pragma once

#include <filesystem>

#include "core/atomic_file.h"
#include "view/image.h"

namespace tenku {

/// An MP4 file (H.264, 4:2:0), made by the program `ffmpeg`, which pictures are sent to one by one.
///
/// The film appears when it is complete. Odd widths and heights are filled up by a black line.
/// Threads  one at a time.
class FilmWriter {
 public:
  /// @param frames_per_s  positive
  /// @throws InputError     no `ffmpeg` on the PATH, or the folder is not there
  /// @throws ResourceError  if `ffmpeg` cannot be started
  FilmWriter(const std::filesystem::path& file, int width, int height, double frames_per_s);
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;

  /// @throws ResourceError  if `ffmpeg` has ended
  void add(const Image8& picture);
  /// @throws ResourceError  if `ffmpeg` fails
  void close();

 private:
  AtomicFile file_;
  int width_, height_;
  int to_program_ = -1;
  int program_ = -1;  ///< its process
};

/// Tells before a long calculation whether `FilmWriter` could start.
/// @throws InputError  saying what to install
void check_can_write_films();

}  // namespace tenku
