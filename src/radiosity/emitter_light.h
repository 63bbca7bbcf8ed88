/// Light straight from surfaces that shine themselves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/rgb.h"
#include "illuminance/sensor.h"
#include "meshing/element_mesh.h"
#include "meshing/mesh_soup.h"
#include "radiosity/side_points.h"
#include "radiosity/surface_light.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// Lamps seen from a point: they are small, and rows of form factors see small things roughly. The
/// form factor of a whole lamp is exact (`contour_factor`); rays to it tell how much of it is seen.
///
/// A lamp is what shines in one plane without a gap. Lamps that give less than kFaint of the light
/// of all at a point are left to its row; so are all where they would fill most of its view, and
/// where more than kMostLamps shine.
///
/// Error    rays that agree, hidden or seen, are believed. Otherwise the shadow's edge crosses
///          about sqrt(n) of n parts of the lamp, each with a variance of at most 1/6 of its
///          square: 0.19 / n^1.5 of the lamp's light squared in all. Rays are added until that is
///          kSettled of the light.
/// Threads  immutable after construction; may be shared.
class EmitterLight {
 public:
  static constexpr double kFaint = 0.015, kMostView = 0.6, kSettled = 0.001;
  static constexpr std::size_t kMostLamps = 512;
  static constexpr int kPixelFirst = 64, kPixelMost = 256, kEdgeFirst = 256, kEdgeMost = 512;

  /// @param mesh  kept by reference
  EmitterLight(const ElementMesh& mesh, const SidePoints& points, const SurfaceLight& surfaces,
               std::uint64_t seed);

  /// What a point receives straight from lamps.
  struct Direct {
    Rgb lux;
    double variance = 0.0;            ///< lux^2, by luminance
    std::vector<std::uint32_t> lamp;  ///< those in `lux`, in rising order

    bool has(std::uint32_t one) const;
  };
  /// @param position  lifted
  /// @param rays      at most, to a lamp that is seen in part
  /// @param in_sight  [lamp], 0 for those that are not: left to the row; empty: all may be
  Direct at(Vec3 position, Vec3 normal, int rays,
            std::span<const std::uint8_t> in_sight = {}) const;

  enum class PixelLook {
    Names,   ///< which lamps count, without their light
    Usual,   ///< kPixelFirst
    OnEdges  ///< kEdgeFirst
  };
  /// The same for points of a picture, each beside its neighbours: lamps are not left to rows for
  /// being near, which would show as an edge, and those that give most of the light have more rays
  /// that must agree before they are believed (one of kPixelFirst may be wrong, unseen; of
  /// kEdgeFirst where neighbours tell of a shadow's edge).
  /// @param points  on their surfaces
  /// @return  [point]
  std::vector<Direct> at_pixels(const Sensors& points, double lift_m, PixelLook look) const;

  bool is_any() const { return !lamp_.empty(); }
  std::size_t size() const { return lamp_.size(); }
  /// Number of the lamp that an element is a part of, or `kNoLamp`.
  std::uint32_t lamp_of(std::size_t element) const { return lamp_of_[element]; }
  static constexpr std::uint32_t kNoLamp = ~0U;

 private:
  struct Lamp {
    std::vector<std::uint32_t> element;
    std::vector<double> area_to;               ///< [element], of all up to it, m2
    std::vector<std::array<Vec3, 2>> outline;  ///< edges, with the front on their left
    Vec3 centre, normal;
    double radius_m = 0.0;
    Rgb exitance;

    double area_m2() const { return area_to.back(); }
  };
  void find_lamps(const SidePoints& points, const SurfaceLight& surfaces);
  struct Rays {
    int first, most;
  };
  double rough_factor(const Lamp& lamp, Vec3 position, Vec3 normal) const;
  Direct at_pixel(Vec3 position, Vec3 normal, PixelLook look) const;
  void add_lamp(std::uint32_t lamp, Vec3 position, Vec3 normal, Rays rays, Direct& direct) const;
  double factor(const Lamp& lamp, Vec3 position, Vec3 normal) const;
  double seen(std::uint32_t lamp, Vec3 position, Vec3 normal, int rays) const;
  bool hides(std::uint32_t element, std::uint32_t lamp, Vec3 point, double away) const;

  const ElementMesh& mesh_;
  std::uint64_t seed_;
  MeshSoup soup_;
  std::unique_ptr<RayVisibility> rays_;
  std::vector<Lamp> lamp_;
  std::vector<std::uint32_t> lamp_of_;  ///< [element]
};

}  // namespace tenku
