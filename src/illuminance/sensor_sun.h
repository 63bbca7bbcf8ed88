/// Sunlight on one sensor, with the penumbra of the solar disc.
#pragma once

#include <cstdint>

#include "core/vec3.h"
#include "sky_models/sky_model.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// Illuminance of one sensor from the visible part of the solar disc, with its standard error.
///
/// Rays to the rim of the disc come first: where they agree, the disc counts as wholly visible or
/// wholly hidden. Otherwise rays are spread over it by an Owen-scrambled Sobol sequence.
///
/// Error    a straight edge that no rim ray sees cuts off at most 0.16 % of the disc. In a
///          penumbra the edge of the shadow crosses about sqrt(n) of n equal cells of the disc,
///          each with a variance of at most 1/6 of its square: variance 0.19 / n^1.5 of a
///          half-covered disc. Otherwise in proportion to the chord: near the rim it goes as the
///          cube root of what it cuts off.
class SensorSun {
 public:
  SensorSun(const RayVisibility& rays, const SolarDisc& sun, Vec3 position, Vec3 normal,
            std::uint64_t scramble);

  /// Sends the rim rays, then, where they disagree, twice as many each time over the disc.
  void refine();

  double lux() const { return lux_; }
  double variance() const { return variance_; }  ///< lux^2
  /// Whether more rays can make the variance smaller.
  bool is_settled() const { return settled_; }
  std::uint64_t rays_sent() const { return rays_sent_; }

  static constexpr unsigned kRimRays = 16, kFirstRays = 16;

 private:
  void ask_rim();
  bool is_in_front(Vec3 direction) const;

  const RayVisibility& rays_;
  const SolarDisc& sun_;
  Vec3 origin_, normal_;
  TangentFrame frame_;
  std::uint64_t scramble_;
  double lit_ = 0.0, seen_ = 0.0, whole_ = 0.0;  ///< sums over the rays of the cosine
  std::uint32_t sent_ = 0;
  std::uint64_t rays_sent_ = 0;
  double lux_ = 0.0, variance_ = 0.0;
  bool settled_ = false;
};

/// Direction to a point of the solar disc chosen by two numbers in [0, 1).
Vec3 direction_on_disc(const SolarDisc& sun, const TangentFrame& frame, double u, double v);

}  // namespace tenku
