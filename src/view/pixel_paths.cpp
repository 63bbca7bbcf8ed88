#include "view/pixel_paths.h"

#include <limits>
#include <string>

#include "beams/beam_tree.h"
#include "beams/mirror_reflectance.h"
#include "beams/region_map.h"
#include "core/random.h"

namespace tenku {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::uint64_t way_over(std::uint64_t way, Vec3 mirror_normal) {
  return mix_rounded(way + 1,
                     {1e6 * mirror_normal.x, 1e6 * mirror_normal.y, 1e6 * mirror_normal.z, 0.0});
}

/// Not what only mirrors: it gives nothing of its own.
bool needs_light(const Material& material, bool is_shown) {
  const bool is_black = material.reflectance == Rgb{} && material.emission_lm_m2 == Rgb{};
  return !is_black || is_shown || !(material.mirror > 0.0);
}

/// What both ways of following share: a ray that goes on from mirror to mirror.
class Ray {
 public:
  Ray(const RayVisibility& rays, const Backdrop& backdrop, const MirrorOptions& options,
      PixelPath& path)
      : rays_(rays), backdrop_(backdrop), light_all_(options.light_all), path_(path) {}

  Rgb weight{1.0, 1.0, 1.0};
  std::uint64_t way = 0;

  /// Panes on a piece of the ray.
  void pass_glass(Vec3 origin, Vec3 direction, double distance_m) {
    if (!rays_.has_glass()) return;
    ++path_.rays;
    weight = rays_.glass_transmission(origin, direction, distance_m) * weight;
  }

  void end_at_background(Vec3 direction) {
    path_.background = path_.background + weight * backdrop_.colour(direction);
  }

  /// @param normal  towards where the ray came from
  void meet(std::uint32_t triangle, Vec3 position, Vec3 normal) {
    if (!needs_light(material_of(triangle), way == 0 && light_all_)) return;
    path_.points.push_back({position, normal, triangle, weight, way});
  }

  void reflect(std::uint32_t triangle, Vec3 normal, double cos_incidence) {
    weight = weight * mirror_reflectance(material_of(triangle), cos_incidence);
    way = way_over(way, normal);
  }

  void end_at_depth(std::uint32_t triangle, double cos_incidence) {
    path_.cut_share =
        luminance_of(weight * mirror_reflectance(material_of(triangle), cos_incidence));
  }

  const Material& material_of(std::uint32_t triangle) const {
    return rays_.materials()[rays_.soup().material[triangle]];
  }

 private:
  const RayVisibility& rays_;
  const Backdrop& backdrop_;
  bool light_all_;
  PixelPath& path_;
};

/// A ray is sent for each piece of the way.
class RayPaths : public PixelPaths {
 public:
  RayPaths(const PerspectiveCamera& camera, const RayVisibility& rays, const Backdrop& backdrop,
           const MirrorOptions& options)
      : camera_(camera), rays_(rays), backdrop_(backdrop), options_(options) {}

  void follow(int x, int y, std::size_t place, PixelPath& path) const override {
    const auto [dx, dy] = kRayPlaces[place];
    Ray ray(rays_, backdrop_, options_, path);
    follow_from(camera_.eye(), camera_.ray(x + dx, y + dy), 0, ray, path);
  }

  /// Goes on with a ray that has met `met` mirrors.
  void follow_from(Vec3 origin, Vec3 direction, int met, Ray& ray, PixelPath& path) const {
    for (;; ++met) {
      ++path.rays;
      const auto hit = rays_.first_hit(origin, direction);
      ray.pass_glass(origin, direction, hit ? hit->distance_m : kInfinity);
      if (!hit) return ray.end_at_background(direction);
      const Vec3 face = rays_.normal(hit->triangle);
      const Vec3 normal = dot(face, direction) < 0.0 ? face : -face;
      const Vec3 position = rays_.on_plane(hit->triangle, origin + hit->distance_m * direction);
      ray.meet(hit->triangle, position, normal);
      if (!(ray.material_of(hit->triangle).mirror > 0.0)) return;
      const double cosine = -dot(normal, direction);
      if (met == options_.depth) return ray.end_at_depth(hit->triangle, cosine);
      ray.reflect(hit->triangle, normal, cosine);
      origin = position + rays_.lift_m() * normal;
      direction = direction + 2.0 * cosine * normal;
    }
  }

 private:
  PerspectiveCamera camera_;
  const RayVisibility& rays_;
  const Backdrop& backdrop_;
  MirrorOptions options_;
};

/// The regions of the picture tell the mirrors and the end of each ray; a ray is sent only where a
/// region ends at surfaces that were not told apart.
class BeamPaths : public PixelPaths {
 public:
  BeamPaths(const PerspectiveCamera& camera, const RayVisibility& rays, const Backdrop& backdrop,
            const MirrorOptions& options, BeamFaces faces, BeamTree tree)
      : rays_(rays),
        backdrop_(backdrop),
        options_(options),
        single_(camera, rays, backdrop, options),
        faces_(std::move(faces)),
        tree_(std::move(tree)),
        map_(tree_, camera.width(), camera.height(), places()),
        width_(camera.width()) {
    for (std::uint32_t b = 0; b < tree_.beams.size(); ++b) {
      std::vector<std::uint32_t> beams;
      for (std::uint32_t at = b; tree_.beams[at].depth > 0; at = tree_.beams[at].parent) {
        beams.insert(beams.begin(), at);
      }
      chain_.push_back(std::move(beams));
      linear_.push_back(LinearDirection(tree_.beams[b].view));
    }
    for (const BeamRegion& region : tree_.regions) is_alone_.push_back(shows_background(region));
  }

  std::optional<Rgb> background_alone(int x, int y) const override {
    const std::size_t pixel = pixel_at(x, y);
    Rgb sum{};
    for (std::size_t s = 0; s < kRayPlaces.size(); ++s) {
      const std::uint32_t r = map_.at(pixel, s);
      if (!is_alone_[r]) return std::nullopt;
      const std::uint32_t b = tree_.regions[r].beam;
      const WindowPoint p{x + kRayPlaces[s][0], y + kRayPlaces[s][1]};
      const Rgb seen = backdrop_.colour(normalized(linear_[b].direction(p)));
      sum = sum + (chain_[b].empty() ? seen : weight_of(b, p) * seen);
    }
    return 1.0 / kRayPlaces.size() * sum;
  }

  void follow(int x, int y, std::size_t place, PixelPath& path) const override {
    const BeamRegion& region = tree_.regions[map_.at(pixel_at(x, y), place)];
    const WindowPoint p{x + kRayPlaces[place][0], y + kRayPlaces[place][1]};
    Ray ray(rays_, backdrop_, options_, path);
    Vec3 origin = tree_.beams[0].view.ray(p).origin;
    Vec3 direction = normalized(tree_.beams[0].view.direction(p));
    for (const std::uint32_t b : chain_[region.beam]) {
      const Beam& beam = tree_.beams[b];
      const Meeting at =
          meet(beam.mirror, tree_.beams[beam.parent].view, p, origin, direction, ray);
      ray.reflect(at.triangle, at.normal, at.cosine);
      origin = at.position + rays_.lift_m() * at.normal;
      direction = direction + 2.0 * at.cosine * at.normal;
    }
    end(region, p, origin, direction, ray, path);
  }

 private:
  struct Meeting {
    std::uint32_t triangle;
    Vec3 position, normal;
    double cosine;
  };

  static std::array<WindowPoint, kRayPlaces.size()> places() {
    std::array<WindowPoint, kRayPlaces.size()> places;
    for (std::size_t s = 0; s < places.size(); ++s)
      places[s] = {kRayPlaces[s][0], kRayPlaces[s][1]};
    return places;
  }

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

  bool shows_background(const BeamRegion& region) const {
    if (region.end != kNoFace || rays_.has_glass()) return false;
    const std::vector<std::uint32_t>& chain = chain_[region.beam];
    for (std::size_t k = 0; k < chain.size(); ++k) {
      const BeamFace& mirror = faces_[tree_.beams[chain[k]].mirror];
      if (needs_light(rays_.materials()[mirror.material], k == 0 && options_.light_all))
        return false;
    }
    return true;
  }

  /// Product of the reflectances of the mirrors that a beam has met.
  Rgb weight_of(std::uint32_t b, WindowPoint p) const {
    Rgb weight{1.0, 1.0, 1.0};
    for (const std::uint32_t at : chain_[b]) {
      const BeamFace& mirror = faces_[tree_.beams[at].mirror];
      const Vec3 direction = normalized(linear_[at].direction(p));
      weight = weight * mirror_reflectance(rays_.materials()[mirror.material],
                                           std::abs(dot(mirror.plane.normal, direction)));
    }
    return weight;
  }

  Meeting meet(std::uint32_t f, const BeamView& view, WindowPoint p, Vec3 origin, Vec3 direction,
               Ray& ray) const {
    const BeamFace& face = faces_[f];
    const double along = dot(face.plane.normal, direction);
    const Vec3 normal = along < 0.0 ? face.plane.normal : -face.plane.normal;
    const Vec3 position = view.on_plane(face.plane, p);
    const std::uint32_t triangle = face.triangles.front();
    if (rays_.has_glass()) ray.pass_glass(origin, direction, length(position - origin));
    ray.meet(triangle, position, normal);
    return {triangle, position, normal, std::abs(along)};
  }

  void end(const BeamRegion& region, WindowPoint p, Vec3 origin, Vec3 direction, Ray& ray,
           PixelPath& path) const {
    const Beam& beam = tree_.beams[region.beam];
    if (region.end == kUndivided) {
      return single_.follow_from(origin, direction, beam.depth, ray, path);
    }
    if (region.end == kNoFace) {
      ray.pass_glass(origin, direction, kInfinity);
      return ray.end_at_background(direction);
    }
    const Meeting at = meet(region.end, beam.view, p, origin, direction, ray);
    if (faces_[region.end].is_mirror) ray.end_at_depth(at.triangle, at.cosine);
  }

  const RayVisibility& rays_;
  const Backdrop& backdrop_;
  MirrorOptions options_;
  RayPaths single_;
  BeamFaces faces_;
  BeamTree tree_;
  RegionMap map_;
  std::vector<std::vector<std::uint32_t>> chain_;  ///< [beam], the first beam left out
  std::vector<LinearDirection> linear_;            ///< [beam]
  std::vector<std::uint8_t> is_alone_;             ///< [region]
  int width_;
};

bool any_mirror(const RayVisibility& rays) {
  for (const std::uint32_t m : rays.soup().material) {
    if (rays.materials()[m].mirror > 0.0) return true;
  }
  return false;
}

Finding fell_back(std::size_t most, std::size_t mirrors) {
  Finding finding;
  finding.code = "mirrors_by_rays";
  finding.what = "mirrors divide the picture into more than " + std::to_string(most) +
                 " regions; they are followed by single rays";
  finding.repair = "nothing to do: the picture is the same";
  finding.count = mirrors;
  return finding;
}

}  // namespace

std::unique_ptr<PixelPaths> pixel_paths(const PerspectiveCamera& camera, const RayVisibility& rays,
                                        const Backdrop& backdrop, const MirrorOptions& options,
                                        Progress& progress, MirrorReport& report) {
  check_mirror_depth(options.depth);
  MirrorOptions followed = options;
  if (options.method == MirrorMethod::Off) followed.depth = 0;
  const auto by_rays = [&] { return std::make_unique<RayPaths>(camera, rays, backdrop, followed); };
  report.used = options.method == MirrorMethod::Off ? MirrorMethod::Off : MirrorMethod::Rays;
  if (options.method == MirrorMethod::Off || options.method == MirrorMethod::Rays) return by_rays();
  const bool may_choose = options.method == MirrorMethod::Auto;
  if (may_choose && !any_mirror(rays)) return by_rays();

  constexpr std::size_t kPixelsARegion = 16, kMostRegions = 4'000'000, kFewFaces = 2000;
  const auto pixels =
      static_cast<std::size_t>(camera.width()) * static_cast<std::size_t>(camera.height());
  BeamFaces faces(rays.soup(), rays.materials());
  report.mirrors = faces.mirrors();
  BeamOptions how;
  how.depth = followed.depth;
  how.told_from = faces.faces().size() <= kFewFaces ? 0 : followed.depth + 1;
  how.most_regions =
      may_choose ? std::max<std::size_t>(1000, pixels / kPixelsARegion) : kMostRegions;
  const double w = camera.width(), h = camera.height();
  const std::array<WindowPoint, 4> window{{{0, 0}, {w, 0}, {w, h}, {0, h}}};
  progress.begin("beams", 0);
  BeamTree tree = trace_beams(faces, camera.window(), window, how, progress);
  progress.end(std::to_string(tree.regions.size()) + " regions");
  if (!tree.is_complete) {
    report.findings.push_back(fell_back(how.most_regions, report.mirrors));
    return by_rays();
  }
  report.used = MirrorMethod::Beams;
  report.regions = tree.regions.size();
  report.queries = tree.queries;
  return std::make_unique<BeamPaths>(camera, rays, backdrop, followed, std::move(faces),
                                     std::move(tree));
}

}  // namespace tenku
