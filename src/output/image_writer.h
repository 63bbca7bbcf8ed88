/// Pictures as files: PNG for the screen, OpenEXR and Radiance HDR for the physical values.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pictures/picture_codec.h"
#include "view/image.h"

namespace tenku {

/// What a picture file says about itself.
struct PictureInfo {
  std::string title;
  std::string time;   ///< the instant shown, ISO 8601
  std::string units;  ///< of the stored values, such as `cd/m2`
};

/// One more channel of an OpenEXR file, such as `illuminance.lx`.
struct PictureLayer {
  std::string name;
  std::vector<double> values;  ///< [row][column]; NaN where there is none
};

/// Writes an 8-bit sRGB PNG.
/// @throws InputError if the folder does not exist; ResourceError if writing fails
void write_png(const std::filesystem::path& path, const Image8& image,
               const PictureInfo& info = {});

/// The bytes of the PNG file that `write_png` writes.
std::string png_bytes(const Image8& image, const PictureInfo& info = {});

/// Writes linear Rec. 709 channels R, G, B and the `layers`, compressed without loss (zip).
///
/// The attribute `whiteLuminance` is 1: a value of 1 is 1 cd/m2.
/// Source   OpenEXR, "Standard Optional Attributes".
/// @throws InputError if the folder does not exist or a layer has another size than the image;
///         ResourceError if writing fails
void write_exr(const std::filesystem::path& path, const Image& image, const PictureInfo& info = {},
               ExrDepth depth = ExrDepth::Float, const std::vector<PictureLayer>& layers = {});

/// Writes a run-length encoded Radiance picture (RGBE).
///
/// The stored numbers are those of the image, cd/m2; the header's EXPOSURE of 179 lm/W makes
/// Radiance's own programs, which take pictures as W/(sr m2), arrive at the same luminance.
/// Error    a relative error of at most 2^-7 of the largest channel, stored rounded down, as
///          Radiance does; its readers add half a step.
/// Source   G. Ward, "Real Pixels", Graphics Gems II, 1991; Radiance reference manual, "Picture
///          file format".
/// @throws as write_exr; InputError for values that are not finite, negative or above 1e37
void write_hdr(const std::filesystem::path& path, const Image& image, const PictureInfo& info = {});

/// `write_exr` or `write_hdr`, by the extension `.exr` or `.hdr` of `path`.
/// @throws InputError for any other extension
void write_luminance_image(const std::filesystem::path& path, const Image& image,
                           const PictureInfo& info = {});

}  // namespace tenku
