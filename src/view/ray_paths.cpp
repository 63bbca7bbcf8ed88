#include "view/ray_paths.h"

#include <limits>

#include "beams/beam_tree.h"
#include "beams/mirror_reflectance.h"
#include "core/random.h"

namespace tenku {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::uint64_t way_over(std::uint64_t way, Vec3 mirror_normal) {
  return mix_rounded(way + 1,
                     {1e6 * mirror_normal.x, 1e6 * mirror_normal.y, 1e6 * mirror_normal.z, 0.0});
}

}  // namespace

bool needs_light(const Material& material, bool is_shown) {
  const bool is_black = material.reflectance == Rgb{} && material.emission_lm_m2 == Rgb{};
  return !is_black || is_shown || !(material.mirror > 0.0);
}

void PathRay::end_at_background(Vec3 direction) {
  path_->background = path_->background + weight_ * backdrop_->colour(direction);
}

void PathRay::meet(std::uint32_t triangle, Vec3 position, Vec3 normal) {
  if (!needs_light(material_of(triangle), way_ == 0 && options_->light_all)) return;
  path_->points.push_back({position, normal, triangle, weight_, way_});
}

void PathRay::reflect(std::uint32_t triangle, Vec3 normal, double cos_incidence) {
  weight_ = weight_ * mirror_reflectance(material_of(triangle), cos_incidence);
  way_ = way_over(way_, normal);
  ++mirrors_;
  panes_ += material_of(triangle).is_glass();
}

void PathRay::end_at_depth(std::uint32_t triangle, double cos_incidence) {
  add_missing(mirrored_share(triangle, cos_incidence));
}

bool PathRay::is_mirrored(std::uint32_t pane, double cos_incidence) const {
  return mirrors_ < options_->depth && mirrored_share(pane, cos_incidence) >= kLeastShare;
}

bool PathRay::pass(std::uint32_t pane, double cos_incidence) {
  weight_ = pane_transmittance(material_of(pane), cos_incidence) * weight_;
  ++panes_;
  return share() >= kLeastShare;
}

double PathRay::mirrored_share(std::uint32_t triangle, double cos_incidence) const {
  return luminance_of(weight_ * mirror_reflectance(material_of(triangle), cos_incidence));
}

bool PathRay::is_past_panes() const { return panes_ >= kMostPanes; }

const Material& PathRay::material_of(std::uint32_t triangle) const {
  return rays_->materials()[rays_->soup().material[triangle]];
}

void RayPaths::follow(int x, int y, std::size_t place, PixelPath& path) const {
  const auto [dx, dy] = kRayPlaces[place];
  follow_from(camera_.eye(), camera_.ray(x + dx, y + dy), PathRay(rays_, backdrop_, options_, path),
              path);
}

void RayPaths::follow_from(Vec3 origin, Vec3 direction, PathRay ray, PixelPath& path) const {
  for (int met = ray.mirrors();; ++met) {
    ++path.rays;
    const auto hit = rays_.first_hit(origin, direction);
    double reach_m = kInfinity;
    Vec3 face, normal;
    double cosine = 0.0;
    if (hit) {
      face = rays_.normal(hit->triangle);
      normal = dot(face, direction) < 0.0 ? face : -face;
      cosine = -dot(normal, direction);
      // A pane in the plane of the wall behind it is before the wall.
      constexpr double kLeastCosine = 1e-3;
      reach_m = hit->distance_m + 2.0 * rays_.lift_m() / std::max(cosine, kLeastCosine);
    }
    if (!pass_panes(origin, direction, reach_m, ray, path)) return;
    if (!hit) return ray.end_at_background(direction);
    const Vec3 position = rays_.on_plane(hit->triangle, origin + hit->distance_m * direction);
    ray.meet(hit->triangle, position, normal);
    if (!(ray.material_of(hit->triangle).mirror > 0.0)) return;
    if (met >= options_.depth) return ray.end_at_depth(hit->triangle, cosine);
    ray.reflect(hit->triangle, normal, cosine);
    origin = position + rays_.lift_m() * normal;
    direction = direction + 2.0 * cosine * normal;
  }
}

/// @return  false where too little of the light goes on
bool RayPaths::pass_panes(Vec3 origin, Vec3 direction, double distance_m, PathRay& ray,
                          PixelPath& path) const {
  if (!rays_.has_glass()) return true;
  ++path.rays;
  std::vector<RayHit> panes;
  rays_.find_panes(origin, direction, distance_m, panes);
  for (const RayHit& hit : panes) {
    const Vec3 face = rays_.normal(hit.triangle);
    const Vec3 normal = dot(face, direction) < 0.0 ? face : -face;
    const double cosine = -dot(normal, direction);
    const Vec3 position = rays_.on_plane(hit.triangle, origin + hit.distance_m * direction);
    if (!ray.is_past_panes() && ray.is_mirrored(hit.triangle, cosine)) {
      PathRay mirrored = ray;
      mirrored.reflect(hit.triangle, normal, cosine);
      follow_from(position + rays_.lift_m() * normal, direction + 2.0 * cosine * normal, mirrored,
                  path);
    } else {
      ray.add_missing(ray.mirrored_share(hit.triangle, cosine));
    }
    if (ray.pass(hit.triangle, cosine)) continue;
    ray.add_missing(ray.share());
    return false;
  }
  return true;
}

}  // namespace tenku
