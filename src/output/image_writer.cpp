#include "output/image_writer.h"

#include <cstdint>
#include <span>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/version.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

PictureHeader header_of(int width, int height, const PictureInfo& info) {
  PictureHeader header{width, height, {"R", "G", "B"}, false, {}};
  header.texts.emplace_back("Software", software_name());
  if (!info.title.empty()) header.texts.emplace_back("ImageDescription", info.title);
  if (!info.time.empty()) header.texts.emplace_back("tenku:time", info.time);
  if (!info.units.empty()) header.texts.emplace_back("tenku:units", info.units);
  return header;
}

void expects_filled(std::size_t pixels, int width, int height) {
  expects(width > 0 && height > 0 &&
              pixels == static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
          "the picture has width * height pixels");
}

std::vector<float> interleaved(const Image& image, const std::vector<PictureLayer>& layers) {
  std::vector<float> values;
  values.reserve(image.pixels.size() * (3 + layers.size()));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const Rgb c = image.pixels[i];
    for (const double v : {c.r, c.g, c.b}) values.push_back(static_cast<float>(v));
    for (const PictureLayer& layer : layers) values.push_back(static_cast<float>(layer.values[i]));
  }
  return values;
}

}  // namespace

std::string png_bytes(const Image8& image, const PictureInfo& info) {
  expects_filled(image.pixels.size(), image.width, image.height);
  static_assert(sizeof(Rgb8) == 3);
  const std::span codes(reinterpret_cast<const std::uint8_t*>(image.pixels.data()),
                        3 * image.pixels.size());
  return picture_codec().png_bytes(header_of(image.width, image.height, info), codes);
}

void write_png(const fs::path& path, const Image8& image, const PictureInfo& info) {
  write_whole_file(path, png_bytes(image, info));
}

void write_exr(const fs::path& path, const Image& image, const PictureInfo& info, ExrDepth depth,
               const std::vector<PictureLayer>& layers) {
  expects_filled(image.pixels.size(), image.width, image.height);
  for (const PictureLayer& layer : layers) {
    if (layer.values.size() != image.pixels.size()) {
      throw InputError("channel " + layer.name + " has " + std::to_string(layer.values.size()) +
                       " values, the picture " + std::to_string(image.pixels.size()));
    }
  }
  PictureHeader header = header_of(image.width, image.height, info);
  for (const PictureLayer& layer : layers) header.channels.push_back(layer.name);
  write_whole_file(path, picture_codec().exr_bytes(header, interleaved(image, layers), depth));
}

void write_luminance_image(const fs::path& path, const Image& image, const PictureInfo& info) {
  const std::string extension = path.extension().string();
  if (extension == ".exr") return write_exr(path, image, info);
  if (extension == ".hdr") return write_hdr(path, image, info);
  throw InputError("cannot write luminance to " + path.string() +
                   ": the name must end in .exr or .hdr");
}

}  // namespace tenku
