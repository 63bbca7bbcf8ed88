#include "view/background.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "pictures/picture_codec.h"
#include "sky_models/image_sky.h"

namespace tenku {
namespace {

struct CubeFace {
  const char* name;
  Vec3 forward, right, up;
};

constexpr std::array<CubeFace, 6> kFaces{{{"east", {1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                                          {"west", {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                          {"north", {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                          {"south", {0, -1, 0}, {-1, 0, 0}, {0, 0, 1}},
                                          {"up", {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}},
                                          {"down", {0, 0, -1}, {1, 0, 0}, {0, 1, 0}}}};

std::size_t face_towards(Vec3 d) {
  const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  if (x >= y && x >= z) return d.x > 0.0 ? 0 : 1;
  if (y >= z) return d.y > 0.0 ? 2 : 3;
  return d.z > 0.0 ? 4 : 5;
}

/// Bilinear between the centres of pixels; the border goes on outwards.
Rgb at(const Image& image, double column, double row) {
  const int last = image.width - 1;
  const double x = std::clamp(column, 0.0, static_cast<double>(last)),
               y = std::clamp(row, 0.0, static_cast<double>(last));
  const int x0 = std::min(static_cast<int>(x), std::max(0, last - 1)),
            y0 = std::min(static_cast<int>(y), std::max(0, last - 1));
  const int x1 = std::min(x0 + 1, last), y1 = std::min(y0 + 1, last);
  const double s = x - x0, t = y - y0;
  const auto pixel = [&](int c, int r) {
    return image.pixels[static_cast<std::size_t>(r) * static_cast<std::size_t>(image.width) +
                        static_cast<std::size_t>(c)];
  };
  return (1.0 - t) * ((1.0 - s) * pixel(x0, y0) + s * pixel(x1, y0)) +
         t * ((1.0 - s) * pixel(x0, y1) + s * pixel(x1, y1));
}

// IEC 61966-2-1.
double linear_from_srgb(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

Image read_face(const std::filesystem::path& folder, const std::string& name, Luminance white) {
  for (const char* ending : {".exr", ".hdr", ".png"}) {
    const std::filesystem::path path = folder / (name + ending);
    if (!std::filesystem::is_regular_file(path)) continue;
    const auto [header, values] = picture_codec().read(path);
    const std::size_t channels = header.channels.size();
    if (channels < 1) throw InputError("'" + path.string() + "' has no channels");
    Image image(header.width, header.height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const auto value = [&](std::size_t k) {
        const double v = values[i * channels + (channels >= 3 ? k : 0)];
        return header.holds_codes ? white.value() * linear_from_srgb(v) : v;
      };
      image.pixels[i] = {value(0), value(1), value(2)};
    }
    return image;
  }
  throw InputError("background '" + folder.string() + "': there is no " + name +
                   ".exr, .hdr or .png");
}

/// A latitude-longitude picture.
class ImageBackground : public Background {
 public:
  explicit ImageBackground(SkyImage image, Luminance level)
      : image_(std::move(image), Angle(), level) {}
  [[nodiscard]] Rgb colour(Vec3 direction) const override { return image_.all_round(direction); }

 private:
  ImageSky image_;
};

}  // namespace

CubeBackground::CubeBackground(std::array<Image, 6> faces) : faces_(std::move(faces)) {
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    if (faces_[k].width < 1 || faces_[k].width != faces_[k].height) {
      throw InputError(std::string("the background's picture '") + kFaces[k].name +
                       "' is not square");
    }
  }
}

Rgb CubeBackground::colour(Vec3 direction) const {
  const std::size_t k = face_towards(direction);
  const CubeFace& face = kFaces[k];
  const double depth = dot(direction, face.forward), half = 0.5 * faces_[k].width;
  return at(faces_[k], half * (1.0 + dot(direction, face.right) / depth) - 0.5,
            half * (1.0 - dot(direction, face.up) / depth) - 0.5);
}

std::unique_ptr<Background> read_background(const std::string& name, Luminance white) {
  if (name.starts_with("image:")) {
    const std::filesystem::path path = name.substr(6);
    SkyImage image = read_sky_image(path);
    const bool holds_codes = picture_codec().read_header(path).holds_codes;
    return std::make_unique<ImageBackground>(std::move(image),
                                             holds_codes ? white : Luminance(1.0));
  }
  if (!name.starts_with("cube:")) {
    throw InputError("background '" + name + "' is unknown; write cube:FOLDER or image:FILE");
  }
  const std::filesystem::path folder = name.substr(5);
  std::array<Image, 6> faces;
  for (std::size_t k = 0; k < faces.size(); ++k)
    faces[k] = read_face(folder, kFaces[k].name, white);
  return std::make_unique<CubeBackground>(std::move(faces));
}

}  // namespace tenku
