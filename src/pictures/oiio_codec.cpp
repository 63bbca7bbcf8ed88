// The plug-in `pictures`: the only file that knows OpenImageIO.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "core/error.h"
#include "pictures/picture_codec.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

OIIO::ImageSpec spec_of(const PictureHeader& header, OIIO::TypeDesc type) {
  OIIO::ImageSpec spec(header.width, header.height, static_cast<int>(header.channels.size()), type);
  spec.channelnames = header.channels;
  for (const auto& [name, text] : header.texts) spec.attribute(name, text);
  return spec;
}

PictureHeader header_of(const OIIO::ImageSpec& spec) {
  PictureHeader header{
      spec.width, spec.height, spec.channelnames, !spec.format.is_floating_point(), {}};
  for (const auto& attribute : spec.extra_attribs) {
    if (attribute.type() == OIIO::TypeString) {
      header.texts.emplace_back(attribute.name().string(), attribute.get_string());
    }
  }
  return header;
}

std::unique_ptr<OIIO::ImageInput> open(const fs::path& path) {
  auto in = OIIO::ImageInput::open(path.string());
  if (!in) throw InputError("cannot read picture " + path.string() + ": " + OIIO::geterror());
  return in;
}

std::string bytes_of(const std::string& format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                     const void* values) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto out = OIIO::ImageOutput::create(format, &memory);
  if (!out) throw ResourceError("cannot make a picture: " + OIIO::geterror());
  if (!out->open("picture." + format, spec) || !out->write_image(type, values) || !out->close()) {
    throw ResourceError("cannot make a picture: " + out->geterror());
  }
  return {bytes.begin(), bytes.end()};
}

class OiioCodec : public PictureCodec {
 public:
  std::string png_bytes(const PictureHeader& header,
                        std::span<const std::uint8_t> codes) const override {
    OIIO::ImageSpec spec = spec_of(header, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    return bytes_of("png", spec, OIIO::TypeDesc::UINT8, codes.data());
  }

  std::string exr_bytes(const PictureHeader& header, std::span<const float> values,
                        ExrDepth depth) const override {
    OIIO::ImageSpec spec =
        spec_of(header, depth == ExrDepth::Half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("whiteLuminance", 1.0F);
    // Rec. 709 primaries and white D65, x and y of each.
    const float primaries[8] = {0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F};
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), primaries);
    return bytes_of("exr", spec, OIIO::TypeDesc::FLOAT, values.data());
  }

  PictureHeader read_header(const fs::path& path) const override {
    return header_of(open(path)->spec());
  }

  StoredPicture read(const fs::path& path) const override {
    const auto in = open(path);
    const OIIO::ImageSpec& spec = in->spec();
    StoredPicture picture{header_of(spec), {}};
    picture.values.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
    if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, picture.values.data())) {
      throw InputError("cannot read picture " + path.string() + ": " + in->geterror());
    }
    return picture;
  }
};

}  // namespace
}  // namespace tenku

const tenku::Plugin* tenku_plugin() {
  static const tenku::OiioCodec codec;
  return &codec;
}
