/// The ways from the eye over mirrors to what is seen: by single rays, or by beams.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/finding.h"
#include "core/progress.h"
#include "core/rgb.h"
#include "sky_models/sky_model.h"
#include "view/background.h"
#include "view/camera.h"
#include "view/mirror_method.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// What is seen where a ray meets nothing.
struct Backdrop {
  const SkyModel* sky = nullptr;          ///< above the horizon; null: black
  Rgb below_horizon{};                    ///< cd/m2
  const Background* all_round = nullptr;  ///< in place of both

  Rgb colour(Vec3 direction) const {
    if (all_round != nullptr) return all_round->colour(direction);
    if (direction.z < 0.0) return below_horizon;
    return sky != nullptr ? sky->colour(direction) : Rgb{};
  }
};

/// Where in a pixel its rays go. A rotated grid: no two share a row or a column.
inline constexpr std::array<std::array<double, 2>, 4> kRayPlaces{
    {{0.125, 0.625}, {0.375, 0.125}, {0.625, 0.875}, {0.875, 0.375}}};

/// A surface on the way.
struct PathPoint {
  Vec3 position, normal;  ///< the normal towards where the ray came from
  std::uint32_t triangle = 0;
  Rgb weight;             ///< of its light in the pixel, before the mirrors that come after it
  std::uint64_t way = 0;  ///< equal for the same mirrors before it; 0: seen directly
};

/// The way of one ray: I = Ia + Ks (Ia' + Ks' (...)), the light of each surface with its weight.
struct PixelPath {
  std::vector<PathPoint> points;
  Rgb background{};  ///< by its weight, cd/m2
  double cut_share =
      0.0;  ///< weight of what lies beyond the last mirror where the depth is reached
  std::uint64_t rays = 0;  ///< sent into the scene

  void clear() { points.clear(), background = {}, cut_share = 0.0; }
};

/// Follows the rays of a picture.
///
/// Threads  immutable; may be shared.
class PixelPaths {
 public:
  virtual ~PixelPaths() = default;

  /// The way of the ray at one of `kRayPlaces` in pixel (x, y), added to a cleared `path`.
  virtual void follow(int x, int y, std::size_t place, PixelPath& path) const = 0;

  /// The mean of the four where they are known to see the background and no surface that is lit.
  virtual std::optional<Rgb> background_alone(int, int) const { return std::nullopt; }
};

/// How mirrors were followed.
struct MirrorReport {
  MirrorMethod used = MirrorMethod::Rays;
  std::size_t mirrors = 0;    ///< faces; 0 also where nobody counted them
  std::size_t regions = 0;    ///< of beams
  std::uint64_t queries = 0;  ///< of the scene, to make them
  std::uint64_t work = 0;     ///< see `BeamTree`
  std::vector<Finding> findings;
};

/// @param rays, backdrop  kept by reference
/// @throws InputError  a depth out of range
std::unique_ptr<PixelPaths> pixel_paths(const PerspectiveCamera& camera, const RayVisibility& rays,
                                        const Backdrop& backdrop, const MirrorOptions& options,
                                        Progress& progress, MirrorReport& report);

}  // namespace tenku
