#include "sky_models/image_sky.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "sky_models/gauss_legendre.h"

namespace tenku {
namespace {

// IEC 61966-2-1.
double linear_from_srgb(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

struct RawImage {
  std::size_t width, height, channels;
  bool is_coded;  // sRGB
  std::vector<float> values;
};

RawImage read_raw(const std::string& path) {
  const auto input = OIIO::ImageInput::open(path);
  if (!input) {
    throw InputError(fmt::format("sky image '{}' cannot be read: {}", path, OIIO::geterror()));
  }
  const OIIO::ImageSpec& spec = input->spec();
  constexpr int kLargestSide = 65536;
  if (spec.width < 8 || spec.height < 4 || spec.width > kLargestSide || spec.nchannels < 1) {
    throw InputError(
        fmt::format("sky image '{}' is {} x {} with {} channels: not an image of a sky", path,
                    spec.width, spec.height, spec.nchannels));
  }
  if (spec.width != 2 * spec.height) {
    throw InputError(fmt::format(
        "sky image '{}' is {} x {}: a latitude-longitude image is twice as wide as high", path,
        spec.width, spec.height));
  }
  RawImage raw{static_cast<std::size_t>(spec.width),
               static_cast<std::size_t>(spec.height),
               static_cast<std::size_t>(spec.nchannels),
               !spec.format.is_floating_point(),
               {}};
  raw.values.resize(raw.width * raw.height * raw.channels);
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, raw.values.data())) {
    throw InputError(fmt::format("sky image '{}' cannot be read: {}", path, input->geterror()));
  }
  return raw;
}

}  // namespace

SkyImage read_sky_image(const std::filesystem::path& path) {
  std::error_code status;
  if (!std::filesystem::is_regular_file(path, status)) {
    throw InputError(fmt::format("sky image '{}': there is no such file", path.string()));
  }
  const RawImage raw = read_raw(path.string());
  SkyImage image{raw.width, raw.height, std::vector<Rgb>(raw.width * raw.height), {}};
  std::size_t repaired = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    double c[3];
    bool is_bad = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const double v = raw.values[i * raw.channels + (raw.channels >= 3 ? k : 0)];
      is_bad = is_bad || !(v >= 0.0) || std::isinf(v);
      c[k] = v >= 0.0 && std::isfinite(v) ? (raw.is_coded ? linear_from_srgb(v) : v) : 0.0;
    }
    image.pixels[i] = {c[0], c[1], c[2]};
    if (is_bad) ++repaired;
  }
  if (repaired > 0) {
    image.findings.push_back({"bad_sky_pixels", Severity::Warning, "", path.string(),
                              fmt::format("{} pixels are negative or no numbers", repaired),
                              "the channels concerned were set to zero", repaired});
  }
  return image;
}

ImageSky::ImageSky(SkyImage image, Angle rotation, Luminance level)
    : image_(std::move(image)), rotation_(rotation), level_(level) {
  expects(image_.pixels.size() == image_.width * image_.height && image_.width >= 2,
          "an image has its pixels");
}

Rgb ImageSky::pixel(std::size_t row, std::ptrdiff_t column) const {
  const auto width = static_cast<std::ptrdiff_t>(image_.width);
  const auto wrapped = static_cast<std::size_t>((column % width + width) % width);
  return image_.pixels[row * image_.width + wrapped];
}

Rgb ImageSky::at(double row, double column) const {
  const double top = std::clamp(row, 0.0, static_cast<double>(image_.height - 1));
  const auto r = std::min(static_cast<std::size_t>(top), image_.height - 2);
  const double v = top - static_cast<double>(r);
  const double left = std::floor(column);
  const auto c = static_cast<std::ptrdiff_t>(left);
  const double u = column - left;
  return (1.0 - v) * ((1.0 - u) * pixel(r, c) + u * pixel(r, c + 1)) +
         v * ((1.0 - u) * pixel(r + 1, c) + u * pixel(r + 1, c + 1));
}

Rgb ImageSky::colour(Vec3 direction) const {
  if (direction.z < 0.0) return {};
  const double azimuth = (azimuth_of(direction) - rotation_).in_radians();
  const double from_zenith = kPi / 2.0 - altitude_of(direction).in_radians();
  const double column = (0.5 + azimuth / (2.0 * kPi)) * static_cast<double>(image_.width) - 0.5;
  const double row = from_zenith / kPi * static_cast<double>(image_.height) - 0.5;
  return level_.value() * at(row, column);
}

Luminance ImageSky::luminance(Vec3 direction) const {
  return Luminance(luminance_of(colour(direction)));
}

Angle ImageSky::detail() const { return Angle::degrees(360.0 / static_cast<double>(image_.width)); }

Illuminance ImageSky::horizontal_illuminance() const {
  // Between the centres of neighbouring rows the image is linear, and along a row the mean of
  // linear pieces is the mean of its pixels: only sin and cos of the row's angle need quadrature.
  static const GaussLegendre rule(4);
  std::vector<double> row_mean(image_.height, 0.0);
  for (std::size_t r = 0; r < image_.height; ++r) {
    for (std::size_t c = 0; c < image_.width; ++c) {
      row_mean[r] += luminance_of(image_.pixels[r * image_.width + c]);
    }
    row_mean[r] /= static_cast<double>(image_.width);
  }
  const double pitch = kPi / static_cast<double>(image_.height);
  const auto mean_at = [&](double from_zenith) {
    const double row =
        std::clamp(from_zenith / pitch - 0.5, 0.0, static_cast<double>(image_.height - 1));
    const auto r = std::min(static_cast<std::size_t>(row), image_.height - 2);
    const double v = row - static_cast<double>(r);
    return (1.0 - v) * row_mean[r] + v * row_mean[r + 1];
  };
  double sum = 0.0;
  const std::size_t half_rows = image_.height;  // half a pixel each, down to the horizon
  for (std::size_t k = 0; k < half_rows; ++k) {
    for (std::size_t i = 0; i < rule.size(); ++i) {
      const double t = 0.5 * pitch * (static_cast<double>(k) + rule.point[i]);
      sum += rule.weight[i] * 0.5 * pitch * mean_at(t) * std::sin(t) * std::cos(t);
    }
  }
  return Illuminance(2.0 * kPi * sum * level_.value());
}

}  // namespace tenku
