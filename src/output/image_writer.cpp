#include "output/image_writer.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <utility>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/version.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

void describe(OIIO::ImageSpec& spec, const PictureInfo& info) {
  spec.attribute("Software", std::string(software_name()));
  if (!info.title.empty()) spec.attribute("ImageDescription", info.title);
  if (!info.time.empty()) spec.attribute("tenku:time", info.time);
  if (!info.units.empty()) spec.attribute("tenku:units", info.units);
}

void expects_filled(std::size_t pixels, int width, int height) {
  expects(width > 0 && height > 0 &&
              pixels == static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
          "the picture has width * height pixels");
}

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw ResourceError("cannot write " + path.string() + ": " + reason);
}

OIIO::ImageSpec png_spec(const Image8& image, const PictureInfo& info) {
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  describe(spec, info);
  return spec;
}

OIIO::ImageSpec exr_spec(const Image& image, const PictureInfo& info, ExrDepth depth,
                         const std::vector<PictureLayer>& layers) {
  const int channels = 3 + static_cast<int>(layers.size());
  OIIO::ImageSpec spec(image.width, image.height, channels,
                       depth == ExrDepth::Half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"R", "G", "B"};
  for (const PictureLayer& layer : layers) spec.channelnames.push_back(layer.name);
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("whiteLuminance", 1.0F);
  // Rec. 709 primaries and white D65, x and y of each.
  const float primaries[8] = {0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F};
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), primaries);
  describe(spec, info);
  return spec;
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
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto out = OIIO::ImageOutput::create("png", &memory);
  if (!out) throw ResourceError("cannot make a PNG: " + OIIO::geterror());
  static_assert(sizeof(Rgb8) == 3);
  if (!out->open("picture.png", png_spec(image, info)) ||
      !out->write_image(OIIO::TypeDesc::UINT8, image.pixels.data()) || !out->close()) {
    throw ResourceError("cannot make a PNG: " + out->geterror());
  }
  return {bytes.begin(), bytes.end()};
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
  AtomicFile target(path);
  const auto out = OIIO::ImageOutput::create("exr");
  if (!out) fail(path, OIIO::geterror());
  if (!out->open(target.path().string(), exr_spec(image, info, depth, layers))) {
    fail(path, out->geterror());
  }
  const std::vector<float> values = interleaved(image, layers);
  if (!out->write_image(OIIO::TypeDesc::FLOAT, values.data())) fail(path, out->geterror());
  if (!out->close()) fail(path, out->geterror());
  target.commit();
}

void write_luminance_image(const fs::path& path, const Image& image, const PictureInfo& info) {
  const std::string extension = path.extension().string();
  if (extension == ".exr") return write_exr(path, image, info);
  if (extension == ".hdr") return write_hdr(path, image, info);
  throw InputError("cannot write luminance to " + path.string() +
                   ": the name must end in .exr or .hdr");
}

StoredPicture read_picture(const fs::path& path) {
  const auto in = OIIO::ImageInput::open(path.string());
  if (!in) throw InputError("cannot read picture " + path.string() + ": " + OIIO::geterror());
  const OIIO::ImageSpec& spec = in->spec();
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> values(spec.image_pixels() * channels);
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data())) {
    throw InputError("cannot read picture " + path.string() + ": " + in->geterror());
  }
  StoredPicture picture{spec.width, spec.height, {}, {}};
  for (std::size_t c = 0; c < channels; ++c) {
    PictureLayer layer{spec.channelnames[c], {}};
    for (std::size_t i = c; i < values.size(); i += channels) layer.values.push_back(values[i]);
    picture.channels.push_back(std::move(layer));
  }
  for (const auto& attribute : spec.extra_attribs) {
    if (attribute.type() == OIIO::TypeString) {
      picture.texts.emplace_back(attribute.name().string(), attribute.get_string());
    }
  }
  return picture;
}

}  // namespace tenku
