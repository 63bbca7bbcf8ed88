/// A photograph or painting of the whole sky.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/finding.h"
#include "sky_models/sky_model.h"

namespace tenku {

/// Pixels of a latitude-longitude (equirectangular) image of all directions.
///
/// Shape    [row][column], row-major, row 0 at the zenith, the last row at the nadir.
/// Frame    the centre column looks north, columns to its right look east, as the sky appears to
///          someone standing under it; the left and right edges look south.
struct SkyImage {
  std::size_t width = 0, height = 0;
  std::vector<Rgb> pixels;        ///< linear Rec. 709
  std::vector<Finding> findings;  ///< negative or non-finite pixels, set to zero
};

/// Reads an HDR, EXR or other image that OpenImageIO knows; 8- and 16-bit images are taken as
/// sRGB-coded, floating-point ones as linear.
/// @throws InputError if the file is missing, cannot be read, or is not twice as wide as high
SkyImage read_sky_image(const std::filesystem::path& path);

/// Sky whose luminance is that of an image, bilinear between pixel centres.
///
/// Units    a pixel value of 1 in all channels is `level`; `kRadianceEfficacy` for images that hold
///          W/m2 sr.
/// Valid    the upper half of the image; what is below the horizon in it gives no light.
class ImageSky : public SkyModel {
 public:
  /// @param rotation  turns the sky clockwise seen from above: what was north comes to this azimuth
  ImageSky(SkyImage image, Angle rotation, Luminance level);

  [[nodiscard]] Luminance luminance(Vec3 direction) const override;
  [[nodiscard]] Rgb colour(Vec3 direction) const override;
  [[nodiscard]] Angle detail() const override;

  /// Colour in any direction, also below the horizon.
  [[nodiscard]] Rgb all_round(Vec3 direction) const;

  /// Unobstructed horizontal illuminance: the bilinear image integrated pixel by pixel.
  /// Error    1e-6 relative.
  [[nodiscard]] Illuminance horizontal_illuminance() const;

  /// The same image at another level.
  void scale(double factor) { level_ = factor * level_; }

 private:
  Rgb pixel(std::size_t row, std::ptrdiff_t column) const;
  Rgb at(double row, double column) const;

  SkyImage image_;
  Angle rotation_;
  Luminance level_;
};

/// Luminous efficacy by which images in W/m2 sr become luminance.
///
/// Source   G. Ward Larson and R. Shakespeare, "Rendering with Radiance", 1998: 179 lm/W of
/// equal-energy white.
inline constexpr double kRadianceEfficacy_lm_W = 179.0;

}  // namespace tenku
