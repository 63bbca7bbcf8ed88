/// Pictures all round the scene, above the horizon and below.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/rgb.h"
#include "core/units.h"
#include "core/vec3.h"
#include "view/image.h"

namespace tenku {

/// What is seen where nothing else is, at no distance; it lights nothing.
///
/// Threads  immutable after construction; may be shared.
class Background {
 public:
  virtual ~Background() = default;

  /// @param direction  unit
  /// @return           cd/m2
  [[nodiscard]] virtual Rgb colour(Vec3 direction) const = 0;
};

/// Six square pictures on the inside of a cube without size.
///
/// Each is what a camera of 90 degrees sees: those to the sides with the zenith upwards, the one
/// overhead and the one underneath with north upwards. Bilinear between pixels of one picture.
class CubeBackground : public Background {
 public:
  /// @param faces  cd/m2; towards east, west, north, south, up, down
  /// @throws InputError  if one is not square
  explicit CubeBackground(std::array<Image, 6> faces);

  [[nodiscard]] Rgb colour(Vec3 direction) const override;

 private:
  std::array<Image, 6> faces_;
};

/// `cube:FOLDER`, with pictures named east, west, north, south, up and down (.exr, .hdr or .png),
/// or `image:FILE`, a picture of all directions as in `SkyImage`.
///
/// Floating-point pictures hold cd/m2; in others white is `white`.
/// @throws InputError  for anything else, or a picture that is missing or has another shape
std::unique_ptr<Background> read_background(const std::string& name, Luminance white);

}  // namespace tenku
