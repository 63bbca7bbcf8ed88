/// Light straight from surfaces that shine themselves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/rgb.h"
#include "radiosity/element_mesh.h"
#include "radiosity/form_factor.h"
#include "radiosity/surface_light.h"
#include "scene/triangle_soup.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// Bright patches seen from a point: a lamp is small, and rows of form factors see small things
/// roughly. The form factor of the whole patch is exact (`contour_factor`); rays to its strata
/// tell how much of it is seen.
///
/// Patches that give less than kBright of the light of all at a point are left to its row, and so
/// are all patches where more than kMostEmitters shine.
///
/// Error    rays that agree, hidden or seen, are believed. Otherwise the shadow's edge crosses
///          about sqrt(n) of n strata, each with a variance of at most 1/6 of its square, taken
///          together: 0.19 / n^1.5 of the patch's light squared.
/// Threads  immutable after construction; may be shared.
class EmitterLight {
 public:
  static constexpr double kBright = 0.015;
  static constexpr std::size_t kMostEmitters = 512;  ///< patch sides

  /// @param mesh, surfaces  kept by reference
  EmitterLight(const ElementMesh& mesh, const SurfaceLight& surfaces, std::uint64_t seed);

  /// What a point receives straight from emitting surfaces.
  struct Direct {
    Rgb lux;
    double variance = 0.0;              ///< lux^2, by luminance
    std::vector<std::uint32_t> bright;  ///< patches that are in `lux`, in rising order

    /// Whether the emission of this element side is in `lux`.
    bool has(std::uint32_t patch) const;
  };
  /// @param position  lifted
  /// @param rays      to a patch that is seen in part; a square number
  Direct at(Vec3 position, Vec3 normal, int rays) const;

  bool is_any() const { return !patch_.empty(); }
  std::uint32_t patch_of(std::uint32_t element) const { return patch_of_[element]; }

 private:
  struct Emitter {
    std::uint32_t patch;
    Vec3 centre, normal;
    double area_m2, radius_m;
    Rgb exitance;
  };
  double factor(const Emitter& emitter, Vec3 position, Vec3 normal) const;
  double seen(const Emitter& emitter, Vec3 position, Vec3 normal, int rays) const;

  const ElementMesh& mesh_;
  std::uint64_t seed_;
  TriangleSoup soup_;
  std::vector<Material> materials_{1};
  std::unique_ptr<RayVisibility> rays_;
  std::vector<Emitter> patch_;
  std::vector<std::uint32_t> patch_of_;  ///< [element]
};

}  // namespace tenku
