/// The ways from the eye by the regions of a picture.
#pragma once

#include "beams/beam_tree.h"
#include "beams/region_map.h"
#include "view/ray_paths.h"

namespace tenku {

/// The regions of the picture tell the mirrors and the end of each ray; a ray is sent only where a
/// region ends at surfaces that were not told apart.
class BeamPaths : public PixelPaths {
 public:
  BeamPaths(const PerspectiveCamera& camera, const RayVisibility& rays, const Backdrop& backdrop,
            const MirrorOptions& options, BeamFaces faces, BeamTree tree);

  std::optional<Rgb> background_alone(int x, int y) const override;
  void follow(int x, int y, std::size_t place, PixelPath& path) const override;

 private:
  /// Where a ray meets a face.
  struct Meeting {
    std::uint32_t triangle;
    Vec3 position, normal;  ///< the normal towards where the ray came from
    double cosine;
  };

  /// The directions of a beam from a point, ready for millions of places.
  struct LinearDirection {
    Vec3 at_origin, by_u, by_v;

    explicit LinearDirection(const BeamView& view)
        : at_origin(view.direction({0.0, 0.0})),
          by_u(view.direction({1.0, 0.0}) - at_origin),
          by_v(view.direction({0.0, 1.0}) - at_origin) {}
    Vec3 direction(WindowPoint p) const { return at_origin + p.u * by_u + p.v * by_v; }
  };

  std::size_t pixel_at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  bool shows_background(const BeamRegion& region) const;
  Rgb weight_of(std::uint32_t beam, WindowPoint p) const;
  Meeting meeting(std::uint32_t face, const BeamView& view, WindowPoint p, Vec3 direction) const;
  void follow_region(const BeamRegion& region, WindowPoint p, PixelPath& path) const;
  bool go_on(const Beam& beam, const Meeting& at, bool is_counted, PathRay& ray) const;
  void end(const BeamRegion& region, WindowPoint p, Vec3 origin, Vec3 direction, PathRay& ray,
           PixelPath& path) const;

  const RayVisibility& rays_;
  const Backdrop& backdrop_;
  MirrorOptions options_;
  RayPaths single_;
  BeamFaces faces_;
  BeamTree tree_;
  RegionMap map_;
  std::vector<std::vector<std::uint32_t>> way_;  ///< [beam], the first beam left out
  std::vector<LinearDirection> linear_;          ///< [beam]
  std::vector<std::uint8_t> is_alone_;           ///< [region]
  int width_;
};

}  // namespace tenku
