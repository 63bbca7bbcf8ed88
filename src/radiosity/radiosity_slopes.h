/// How what a side sends varies over it.
#pragma once

#include <array>
#include <vector>

#include "core/rgb.h"
#include "illuminance/sensor.h"
#include "meshing/element_mesh.h"
#include "radiosity/side_points.h"
#include "radiosity/surface_light.h"

namespace tenku {

/// The reflected radiosity of each side as a linear function of place: its mean as it is, and the
/// slopes of the light at its corners, as far as nothing becomes negative.
///
/// And the daylight straight from sun and sky, between the corners.
///
/// Threads  immutable after construction; may be shared.
class RadiositySlopes {
 public:
  /// @param light   at the corners [point], all of it. Kept by reference, as the mesh
  /// @param mean    what each side sends without what it emits [element side], lm/m2
  /// @param counts  bits of the corners of each side whose light counts; others leave it level
  RadiositySlopes(const ElementMesh& mesh, const SidePoints& points, const SurfaceLight& surfaces,
                  const SensorIlluminance& light, const std::vector<Rgb>& mean,
                  const std::vector<std::uint8_t>& counts);

  /// What a side sends at a place on it, less its mean, lm/m2.
  Rgb beyond_mean(std::uint32_t side, Vec3 place) const;

  /// Whether what a side sends differs from its mean by kLevel of it at most.
  bool is_level(std::uint32_t side) const { return is_level_[side]; }
  static constexpr double kLevel = 0.05;

  /// Straight from sun and sky at a place on a side, lux.
  double daylight_lux(std::uint32_t side, Vec3 place) const;

 private:
  std::array<double, 3> shares(std::uint32_t side, Vec3 place) const;

  const ElementMesh& mesh_;
  const SidePoints& points_;
  const SensorIlluminance& light_;
  std::vector<std::array<Rgb, 3>> corner_;  ///< [element side], less the mean
  std::vector<bool> is_level_;              ///< [element side]
};

}  // namespace tenku
