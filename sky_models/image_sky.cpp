#include "sky_models/image_sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "pictures/picture_codec.h"
#include "sky_models/gauss_legendre.h"

namespace tenku {
namespace {

// IEC 61966-2-1.
double linear_from_srgb(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

void check_shape(const PictureHeader& header, const std::string& path) {
  constexpr int kLargestSide = 65536;
  if (header.width < 8 || header.height < 4 || header.width > kLargestSide ||
      header.channels.empty()) {
    throw InputError(
        fmt::format("sky image '{}' is {} x {} with {} channels: not an image of a sky", path,
                    header.width, header.height, header.channels.size()));
  }
  if (header.width != 2 * header.height) {
    throw InputError(fmt::format(
        "sky image '{}' is {} x {}: a latitude-longitude image is twice as wide as high", path,
        header.width, header.height));
  }
}

}  // namespace

SkyImage read_sky_image(const std::filesystem::path& path) {
  std::error_code status;
  if (!std::filesystem::is_regular_file(path, status)) {
    throw InputError(fmt::format("sky image '{}': there is no such file", path.string()));
  }
  check_shape(picture_codec().read_header(path), path.string());
  const auto [header, values] = picture_codec().read(path);
  const std::size_t channels = header.channels.size();
  SkyImage image;
  image.width = static_cast<std::size_t>(header.width);
  image.height = static_cast<std::size_t>(header.height);
  image.pixels.resize(image.width * image.height);
  std::size_t repaired = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    double c[3];
    bool is_bad = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const double v = values[i * channels + (channels >= 3 ? k : 0)];
      is_bad = is_bad || !(v >= 0.0) || std::isinf(v);
      c[k] = v >= 0.0 && std::isfinite(v) ? (header.holds_codes ? linear_from_srgb(v) : v) : 0.0;
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
  return direction.z < 0.0 ? Rgb{} : all_round(direction);
}

Rgb ImageSky::all_round(Vec3 direction) const {
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
