/// The ways from the eye by single rays, and what both methods do alike at mirrors and panes.
#pragma once

#include "view/pixel_paths.h"

namespace tenku {

/// Not what only mirrors: it gives nothing of its own.
bool needs_light(const Material& material, bool is_shown);

/// A ray on its way from mirror to mirror. Where a pane mirrors, a copy goes on beside it.
class PathRay {
 public:
  PathRay(const RayVisibility& rays, const Backdrop& backdrop, const MirrorOptions& options,
          PixelPath& path)
      : rays_(&rays), backdrop_(&backdrop), options_(&options), path_(&path) {}

  void end_at_background(Vec3 direction);

  /// Lights the surface, if it has anything to show.
  /// @param normal  towards where the ray came from
  void meet(std::uint32_t triangle, Vec3 position, Vec3 normal);

  void reflect(std::uint32_t triangle, Vec3 normal, double cos_incidence);

  /// What lies beyond a mirror at the last depth is missing.
  void end_at_depth(std::uint32_t triangle, double cos_incidence);

  /// Whether what a pane mirrors is followed.
  bool is_mirrored(std::uint32_t pane, double cos_incidence) const;

  /// Goes straight on through a pane.
  /// @return  false where too little goes on
  bool pass(std::uint32_t pane, double cos_incidence);

  void add_missing(double share) { path_->cut_share += share; }
  int mirrors() const { return mirrors_; }
  double share() const { return luminance_of(weight_); }
  double mirrored_share(std::uint32_t triangle, double cos_incidence) const;
  bool is_past_panes() const;
  const Material& material_of(std::uint32_t triangle) const;

 private:
  const RayVisibility* rays_;
  const Backdrop* backdrop_;
  const MirrorOptions* options_;
  PixelPath* path_;
  Rgb weight_{1.0, 1.0, 1.0};
  std::uint64_t way_ = 0;
  int mirrors_ = 0, panes_ = 0;
};

/// A ray is sent for each piece of the way.
class RayPaths : public PixelPaths {
 public:
  RayPaths(const PerspectiveCamera& camera, const RayVisibility& rays, const Backdrop& backdrop,
           const MirrorOptions& options)
      : camera_(camera), rays_(rays), backdrop_(backdrop), options_(options) {}

  void follow(int x, int y, std::size_t place, PixelPath& path) const override;

  /// Goes on with a ray that has met mirrors.
  void follow_from(Vec3 origin, Vec3 direction, PathRay ray, PixelPath& path) const;

 private:
  bool pass_panes(Vec3 origin, Vec3 direction, double distance_m, PathRay& ray,
                  PixelPath& path) const;

  PerspectiveCamera camera_;
  const RayVisibility& rays_;
  const Backdrop& backdrop_;
  MirrorOptions options_;
};

}  // namespace tenku
