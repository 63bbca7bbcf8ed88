/// Points of a fly-through: where they lie, what they are, and what light they receive.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/extent.h"
#include "core/rgb.h"
#include "core/units.h"
#include "core/vec3.h"

namespace tenku {

/// Lines on the surface beyond which a point's disc does not go on: up to two, each by the
/// direction from it into the disc and its distance from the point.
///
/// Shape    line k: code[2 k], the direction's angle about the normal from the tangent of
///          `tangent_frame(normal)` towards its bitangent, 256 to a turn; code[2 k + 1], 0 for no
///          line, or 1 + 254 times the distance over `kReach` footprints.
struct PointBorders {
  static constexpr double kReach = 1.5;  ///< footprints
  std::array<std::uint8_t, 4> code{};

  friend bool operator==(const PointBorders&, const PointBorders&) = default;
  bool has(std::size_t k) const { return code[2 * k + 1] != 0; }
  double angle_rad(std::size_t k) const { return code[2 * k] * (2.0 * kPi / 256.0); }
  double distance_footprints(std::size_t k) const { return (code[2 * k + 1] - 1) * kReach / 254.0; }
  /// @param distance_footprints  in [0, `kReach`]
  void set(std::size_t k, double angle_rad, double distance_footprints) {
    const auto turn = static_cast<int>(std::lround(angle_rad * 256.0 / (2.0 * kPi)));
    code[2 * k] = static_cast<std::uint8_t>(turn & 255);
    code[2 * k + 1] =
        static_cast<std::uint8_t>(1 + std::lround(254.0 * distance_footprints / kReach));
  }
};

/// Surface points that a camera path sees, as a structure of arrays: all [point].
///
/// A point stands for a disc on its surface: `footprint_m` is the width that a sample of the
/// picture covered there.
///
/// Frame    local east, north, up, origin at the site; normals are unit vectors on the side that
///          was seen.
/// Units    metres.
struct StoredPoints {
  std::vector<Vec3> position, normal;
  std::vector<float> footprint_m;
  std::vector<std::uint32_t> object;    ///< index into the objects of the scene
  std::vector<std::uint16_t> material;  ///< index into `StoreHeader::materials`
  /// 1 within a pixel of where another surface is seen, otherwise 0: such discs must stay small.
  std::vector<std::uint8_t> is_edge;
  std::vector<PointBorders> borders;

  std::size_t size() const { return position.size(); }
  bool empty() const { return position.empty(); }
  Extent extent() const;
  /// The chosen ones, in the order of `chosen`.
  StoredPoints of(const std::vector<std::uint32_t>& chosen) const;
};

/// What the points receive under one sun and sky, its parts apart. Shape  all [point].
///
/// The luminance of a point is (sun + sky + reflected) times its reflectance over pi, and its
/// emission over pi.
struct PointLight {
  std::vector<float> sun_lux, sky_lux;
  std::vector<Rgb> reflected_lux;  ///< linear Rec. 709, lux each
  /// What relighting needs: cosine-weighted visible fraction of the sky dome, 0 to 1.
  std::vector<float> sky_view;

  explicit PointLight(std::size_t points = 0)
      : sun_lux(points), sky_lux(points), reflected_lux(points), sky_view(points) {}
  std::size_t size() const { return sun_lux.size(); }
  /// Sun and sky are white.
  Rgb total_lux(std::size_t i) const {
    return Rgb::grey(double{sun_lux[i]} + double{sky_lux[i]}) + reflected_lux[i];
  }
};

}  // namespace tenku
