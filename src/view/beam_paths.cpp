#include "view/beam_paths.h"

#include "beams/mirror_reflectance.h"

namespace tenku {
namespace {

std::array<WindowPoint, kRayPlaces.size()> places() {
  std::array<WindowPoint, kRayPlaces.size()> places;
  for (std::size_t s = 0; s < places.size(); ++s) places[s] = {kRayPlaces[s][0], kRayPlaces[s][1]};
  return places;
}

}  // namespace

BeamPaths::BeamPaths(const PerspectiveCamera& camera, const RayVisibility& rays,
                     const Backdrop& backdrop, const MirrorOptions& options, BeamFaces faces,
                     BeamTree tree)
    : rays_(rays),
      backdrop_(backdrop),
      options_(options),
      single_(camera, rays, backdrop, options),
      faces_(std::move(faces)),
      tree_(std::move(tree)),
      map_(tree_, camera.width(), camera.height(), places()),
      width_(camera.width()) {
  for (std::uint32_t b = 0; b < tree_.beams.size(); ++b) {
    way_.push_back(tree_.way_to(b));
    linear_.push_back(LinearDirection(tree_.beams[b].view));
  }
  for (const BeamRegion& region : tree_.regions) is_alone_.push_back(shows_background(region));
}

std::optional<Rgb> BeamPaths::background_alone(int x, int y) const {
  const std::size_t pixel = pixel_at(x, y);
  Rgb sum{};
  for (std::size_t s = 0; s < kRayPlaces.size(); ++s) {
    const std::uint32_t r = map_.at(pixel, s);
    if (!is_alone_[r]) return std::nullopt;
    const std::uint32_t b = tree_.regions[r].beam;
    const WindowPoint p{x + kRayPlaces[s][0], y + kRayPlaces[s][1]};
    const Rgb seen = backdrop_.colour(normalized(linear_[b].direction(p)));
    sum = sum + (way_[b].empty() ? seen : weight_of(b, p) * seen);
  }
  return 1.0 / kRayPlaces.size() * sum;
}

void BeamPaths::follow(int x, int y, std::size_t place, PixelPath& path) const {
  const std::size_t pixel = pixel_at(x, y);
  const WindowPoint p{x + kRayPlaces[place][0], y + kRayPlaces[place][1]};
  follow_region(tree_.regions[map_.at(pixel, place)], p, path);
  for (const std::uint32_t r : map_.mirrored_at(pixel, place)) {
    follow_region(tree_.regions[r], p, path);
  }
}

void BeamPaths::follow_region(const BeamRegion& region, WindowPoint p, PixelPath& path) const {
  PathRay ray(rays_, backdrop_, options_, path);
  Vec3 origin = tree_.beams[0].view.ray(p).origin;
  Vec3 direction = normalized(tree_.beams[0].view.direction(p));
  const std::uint32_t layer = tree_.beams[region.beam].layer;
  for (const std::uint32_t b : way_[region.beam]) {
    const Beam& beam = tree_.beams[b];
    const Beam& before = tree_.beams[beam.parent];
    const Meeting at = meeting(beam.mirror, before.view, p, direction);
    // Of regions that share a piece of their way one counts what is seen on it: that which no pane
    // mirrors any more.
    if (!go_on(beam, at, before.layer == layer, ray)) return;
    if (beam.is_through) {
      // Panes within half a lift of the origin have been met; a wall in their plane has not.
      constexpr double kBeforePane = 0.4;
      origin = at.position + kBeforePane * rays_.lift_m() * at.normal;
      continue;
    }
    origin = at.position + rays_.lift_m() * at.normal;
    direction = direction + 2.0 * at.cosine * at.normal;
  }
  end(region, p, origin, direction, ray, path);
}

/// Takes the ray over the face by which a beam left its parent.
/// @return  false where it ends
bool BeamPaths::go_on(const Beam& beam, const Meeting& at, bool is_counted, PathRay& ray) const {
  if (beam.is_through) {
    if (is_counted && !ray.is_mirrored(at.triangle, at.cosine)) {
      ray.add_missing(ray.mirrored_share(at.triangle, at.cosine));
    }
    if (ray.pass(at.triangle, at.cosine)) return true;
    if (is_counted) ray.add_missing(ray.share());
    return false;
  }
  if (!faces_[beam.mirror].is_pane) {
    if (is_counted) ray.meet(at.triangle, at.position, at.normal);
  } else if (!ray.is_mirrored(at.triangle, at.cosine)) {
    return false;
  }
  ray.reflect(at.triangle, at.normal, at.cosine);
  return true;
}

bool BeamPaths::shows_background(const BeamRegion& region) const {
  if (region.end != kNoFace) return false;
  const std::vector<std::uint32_t>& way = way_[region.beam];
  for (std::size_t k = 0; k < way.size(); ++k) {
    const BeamFace& face = faces_[tree_.beams[way[k]].mirror];
    if (face.is_pane) return false;
    if (needs_light(rays_.materials()[face.material], k == 0 && options_.light_all)) return false;
  }
  return true;
}

/// Product of the reflectances of the mirrors that a beam has met.
Rgb BeamPaths::weight_of(std::uint32_t beam, WindowPoint p) const {
  Rgb weight{1.0, 1.0, 1.0};
  for (const std::uint32_t at : way_[beam]) {
    const BeamFace& mirror = faces_[tree_.beams[at].mirror];
    const Vec3 direction = normalized(linear_[at].direction(p));
    weight = weight * mirror_reflectance(rays_.materials()[mirror.material],
                                         std::abs(dot(mirror.plane.normal, direction)));
  }
  return weight;
}

BeamPaths::Meeting BeamPaths::meeting(std::uint32_t f, const BeamView& view, WindowPoint p,
                                      Vec3 direction) const {
  const BeamFace& face = faces_[f];
  const double along = dot(face.plane.normal, direction);
  const Vec3 normal = along < 0.0 ? face.plane.normal : -face.plane.normal;
  return {face.triangles.front(), view.on_plane(face.plane, p), normal, std::abs(along)};
}

void BeamPaths::end(const BeamRegion& region, WindowPoint p, Vec3 origin, Vec3 direction,
                    PathRay& ray, PixelPath& path) const {
  if (region.end == kUndivided) return single_.follow_from(origin, direction, ray, path);
  if (region.end == kNoFace) return ray.end_at_background(direction);
  const Meeting at = meeting(region.end, tree_.beams[region.beam].view, p, direction);
  ray.meet(at.triangle, at.position, at.normal);
  if (faces_[region.end].is_mirror) ray.end_at_depth(at.triangle, at.cosine);
}

}  // namespace tenku
