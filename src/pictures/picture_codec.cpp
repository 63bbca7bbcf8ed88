#include "pictures/picture_codec.h"

namespace tenku {

const PictureCodec& picture_codec() {
  static const auto& codec = dynamic_cast<const PictureCodec&>(load_plugin("pictures"));
  return codec;
}

std::string_view openimageio_version() { return TENKU_OPENIMAGEIO_VERSION; }

}  // namespace tenku
