/// Picture files as numbers and names. OpenImageIO stands behind, loaded at first use.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/plugin.h"

namespace tenku {

/// What a picture file says before its pixels.
struct PictureHeader {
  int width = 0, height = 0;
  std::vector<std::string> channels;  ///< their names, such as `R`, `G`, `B`
  bool holds_codes = false;           ///< as read: integers for a screen, not physical values
  std::vector<std::pair<std::string, std::string>> texts;  ///< metadata that is text
};

/// Picture as read from a file.
struct StoredPicture {
  PictureHeader header;
  std::vector<float> values;  ///< [row][column][channel], as stored; integer codes become 0..1
};

/// Bits of a value in an OpenEXR file.
enum class ExrDepth {
  Half,  ///< 11 significant bits, up to 65504
  Float  ///< 24 significant bits
};

/// Turns pictures into files and back.
///
/// Shape    values are [row][column][channel], row-major; row 0 is the top.
/// Threads  may be used by many at once.
class PictureCodec : public Plugin {
 public:
  /// The bytes of an 8-bit sRGB PNG file.
  /// @throws ResourceError if it cannot be made
  virtual std::string png_bytes(const PictureHeader& header,
                                std::span<const std::uint8_t> codes) const = 0;

  /// The bytes of an OpenEXR file, compressed without loss (zip); R, G, B are linear Rec. 709 in
  /// cd/m2.
  /// @throws ResourceError if it cannot be made
  virtual std::string exr_bytes(const PictureHeader& header, std::span<const float> values,
                                ExrDepth depth) const = 0;

  /// The header alone, by which to refuse a picture before memory is taken for its pixels.
  /// @throws InputError if it cannot be read
  virtual PictureHeader read_header(const std::filesystem::path& path) const = 0;

  /// Any picture file that OpenImageIO knows.
  /// @throws InputError if it cannot be read
  virtual StoredPicture read(const std::filesystem::path& path) const = 0;
};

/// The one way to picture files.
/// @throws ResourceError if the plug-in `pictures` cannot be loaded
const PictureCodec& picture_codec();

/// Version of OpenImageIO, such as `2.4.7.1`; does not load it.
std::string_view openimageio_version();

}  // namespace tenku
