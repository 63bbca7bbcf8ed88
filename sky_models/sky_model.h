/// The sky as a function of direction: the one interface that every sky model fulfils.
#pragma once

#include "core/rgb.h"
#include "core/units.h"
#include "core/vec3.h"

namespace tenku {

/// Luminance of the sky, without the solar disc.
///
/// Frame    x east, y north, z up; directions are unit vectors from the observer to the sky.
/// Threads  immutable after construction; may be shared.
class SkyModel {
 public:
  virtual ~SkyModel() = default;

  /// Luminance of the sky in `direction`; zero below the horizon.
  [[nodiscard]] virtual Luminance luminance(Vec3 direction) const = 0;

  /// The same in linear Rec. 709 RGB, cd/m2; its luminance is `luminance(direction)`. White
  /// unless the model knows colour.
  [[nodiscard]] virtual Rgb colour(Vec3 direction) const {
    return Rgb::grey(luminance(direction).value());
  }

  /// Smallest angle over which the model varies: sets the pitch of tables made from it.
  [[nodiscard]] virtual Angle detail() const { return Angle::degrees(1.0); }
};

/// The sun as a uniform disc.
struct SolarDisc {
  Vec3 direction = kZenith;                          ///< unit, to its centre
  Angle angular_radius = Angle::degrees(0.533 / 2);  ///< by the date's distance where known
  Illuminance normal_illuminance{};                  ///< on a plane facing it; 0: no sun
};

}  // namespace tenku
