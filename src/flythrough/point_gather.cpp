#include "flythrough/point_gather.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/parallel.h"
#include "flythrough/point_store.h"
#include "flythrough/surface_borders.h"
#include "view/pixel_paths.h"

namespace tenku {
namespace {

constexpr double kAlikeCosine = 0.9063;    // 25 degrees: a stored normal against the true one
constexpr double kOneFaceCosine = 0.9945;  // 6 degrees: light differs visibly beyond
constexpr std::size_t kRows = 8;           // a piece of work
constexpr int kGlassEvery = 8;             // pixels a side of which one is asked for panes

/// What a ray from the eye meets.
struct Surface {
  std::uint32_t triangle = RayVisibility::kNoTriangle;
  Vec3 normal;          ///< towards the eye
  double height = 0.0;  ///< of the eye above the plane, m
  std::uint32_t material = 0;

  bool is_there() const { return triangle != RayVisibility::kNoTriangle; }
};

class FrameGatherer {
 public:
  FrameGatherer(const PerspectiveView& view, const SplatRule& rule, const RayVisibility& rays,
                std::span<const SplatChunk* const> stored)
      : camera_(view), rays_(rays), stored_(stored), buffer_(view, rule.stricter()) {
    buffer_.draw(stored);
  }

  GatheredFrame gather(const Progress& progress) {
    const auto height = static_cast<std::size_t>(camera_.height());
    trace_middles(progress);
    std::vector<GatheredFrame> parts((height + kRows - 1) / kRows);
    parallel_for(parts.size(), 1, [&](IndexRange range) {
      progress.stop_if_cancelled();
      for (std::size_t part = range.begin; part < range.end; ++part) {
        for (std::size_t y = part * kRows; y < std::min(height, (part + 1) * kRows); ++y) {
          for (int x = 0; x < camera_.width(); ++x) visit(x, static_cast<int>(y), parts[part]);
        }
      }
    });
    GatheredFrame all;
    all.rays = item_.size();
    for (const GatheredFrame& part : parts) add(part, all);
    return all;
  }

 private:
  void trace_middles(const Progress& progress) {
    const auto width = static_cast<std::size_t>(camera_.width()),
               height = static_cast<std::size_t>(camera_.height());
    item_.resize(width * height);
    parallel_for(height, kRows, [&](IndexRange range) {
      progress.stop_if_cancelled();
      std::vector<Vec3> direction;
      for (std::size_t y = range.begin; y < range.end; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
          direction.push_back(
              camera_.ray(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5));
        }
      }
      rays_.first_triangles(camera_.eye(), direction,
                            std::span(item_).subspan(range.begin * width, direction.size()));
    });
  }

  static void add(const GatheredFrame& part, GatheredFrame& all) {
    const auto append = [](const auto& from, auto& to) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(part.points.position, all.points.position);
    append(part.points.normal, all.points.normal);
    append(part.points.footprint_m, all.points.footprint_m);
    append(part.points.object, all.points.object);
    append(part.points.material, all.points.material);
    append(part.points.is_edge, all.points.is_edge);
    append(part.points.borders, all.points.borders);
    all.rays += part.rays;
    all.surface_pixels += part.surface_pixels;
    all.glass_pixels += part.glass_pixels;
    all.mirror_pixels += part.mirror_pixels;
  }

  std::uint32_t item(int x, int y) const {
    x = std::clamp(x, 0, camera_.width() - 1);
    y = std::clamp(y, 0, camera_.height() - 1);
    return item_[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width()) +
                 static_cast<std::size_t>(x)];
  }

  Surface surface(std::uint32_t triangle) const {
    Surface s;
    if (triangle == RayVisibility::kNoTriangle) return s;
    s.triangle = triangle;
    s.normal = rays_.normal(triangle);
    const TriangleSoup& soup = rays_.soup();
    s.height = dot(s.normal, camera_.eye() - soup.vertices[soup.triangles[triangle][0]]);
    if (s.height < 0.0) s.normal = -s.normal, s.height = -s.height;
    s.material = soup.material[triangle];
    return s;
  }

  /// Where the ray in `direction`, of any length, meets the plane; nothing if it runs along it.
  std::optional<Vec3> on(const Surface& s, Vec3 direction) const {
    const double towards = -dot(s.normal, direction);
    const double most = 1e6 * length(direction);
    if (!(towards * most > s.height)) return std::nullopt;
    return camera_.eye() + (s.height / towards) * direction;
  }

  double pixel_m(Vec3 point) const {
    return camera_.footprint_m(dot(point - camera_.eye(), camera_.forward()));
  }

  bool is_one_face(const Surface& a, Vec3 at, const Surface& b, Vec3 towards_b) const {
    if (a.triangle == b.triangle) return true;
    if (!b.is_there() || a.material != b.material) return false;
    if (dot(a.normal, b.normal) < kOneFaceCosine) return false;
    const auto point = on(b, towards_b);
    return point && std::abs(dot(a.normal, *point - at)) < pixel_m(at);
  }

  bool is_edge(int x, int y, const Surface& here, Vec3 at) const {
    static constexpr std::array<std::array<int, 2>, 8> kAround{
        {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
    for (const auto& [dx, dy] : kAround) {
      const std::uint32_t other = item(x + dx, y + dy);
      if (other == here.triangle) continue;
      if (!is_one_face(here, at, surface(other), camera_.ray(x + dx + 0.5, y + dy + 0.5))) {
        return true;
      }
    }
    return false;
  }

  bool is_sky_alone(int x, int y) const {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (item(x + dx, y + dy) != RayVisibility::kNoTriangle) return false;
      }
    }
    return true;
  }

  /// Whether the point of a sample lies on the true surface, or before it.
  bool is_covered(std::size_t sample, const Surface& truth, Vec3 at) const {
    const std::uint32_t found = buffer_.item()[sample];
    if (found == SplatBuffer::kNothing) return false;
    const auto place = buffer_.place(found);
    const SplatChunk& chunk = *stored_[place.chunk];
    const SplatChunk::Point& point = chunk.points[place.point];
    const double pixel = pixel_m(at);
    const double off = dot(truth.normal, chunk.position(place.point) - at);
    if (point.material == truth.material &&
        dot(chunk.normal(place.point), truth.normal) > kAlikeCosine &&
        std::abs(off) < 0.5 * double{point.footprint_m} + 0.25 * pixel) {
      return true;
    }
    const double depth = dot(at - camera_.eye(), camera_.forward());
    return 1.0 / double{buffer_.inverse_depth()[sample]} < depth - 2.0 * pixel;
  }

  void store(const Surface& s, Vec3 at, bool is_edge, GatheredFrame& made) const {
    made.points.position.push_back(at);
    const double footprint = (is_edge ? 0.5 : 1.0) * pixel_m(at);
    const Vec3 normal = as_stored_normal(s.normal);
    made.points.normal.push_back(normal);
    made.points.footprint_m.push_back(static_cast<float>(footprint));
    made.points.object.push_back(rays_.soup().object[s.triangle]);
    made.points.material.push_back(static_cast<std::uint16_t>(s.material));
    made.points.is_edge.push_back(is_edge ? 1 : 0);
    made.points.borders.push_back(is_edge ? borders_near(rays_, s.triangle, at, normal, footprint)
                                          : PointBorders{});
  }

  void visit(int x, int y, GatheredFrame& made) const {
    const Surface here = surface(item(x, y));
    if (!here.is_there()) {
      if (!is_sky_alone(x, y)) visit_edge(x, y, made);
      return;
    }
    const auto at = on(here, camera_.ray(x + 0.5, y + 0.5));
    if (!at) return;
    count(x, y, here, *at, made);
    if (is_edge(x, y, here, *at)) return visit_edge(x, y, made);
    for (std::size_t s = 0; s < SplatBuffer::kSamples; ++s) {
      const auto there = on(here, sample_ray(x, y, s));
      if (there && !is_covered(buffer_.index(x, y, s), here, *there)) {
        return store(here, *at, false, made);
      }
    }
  }

  Vec3 sample_ray(int x, int y, std::size_t s) const {
    return camera_.ray(x + kRayPlaces[s][0], y + kRayPlaces[s][1]);
  }

  void visit_edge(int x, int y, GatheredFrame& made) const {
    std::array<Vec3, SplatBuffer::kSamples> direction;
    std::array<std::uint32_t, SplatBuffer::kSamples> triangle{};
    for (std::size_t s = 0; s < direction.size(); ++s) direction[s] = sample_ray(x, y, s);
    rays_.first_triangles(camera_.eye(), direction, triangle);
    made.rays += direction.size();
    for (std::size_t s = 0; s < direction.size(); ++s) {
      const Surface truth = surface(triangle[s]);
      if (!truth.is_there()) continue;
      const auto at = on(truth, direction[s]);
      if (at && !is_covered(buffer_.index(x, y, s), truth, *at)) store(truth, *at, true, made);
    }
  }

  void count(int x, int y, const Surface& here, Vec3 at, GatheredFrame& made) const {
    ++made.surface_pixels;
    if (rays_.materials()[here.material].mirror > 0.0) ++made.mirror_pixels;
    if (!rays_.has_glass() || x % kGlassEvery != 0 || y % kGlassEvery != 0) return;
    const Vec3 way = at - camera_.eye();
    const double distance = length(way);
    ++made.rays;
    if (rays_.glass_transmission(camera_.eye(), (1.0 / distance) * way, distance) < 1.0) {
      ++made.glass_pixels;
    }
  }

  PerspectiveCamera camera_;
  const RayVisibility& rays_;
  std::span<const SplatChunk* const> stored_;
  SplatBuffer buffer_;
  std::vector<std::uint32_t> item_;  ///< [row][column], triangles
};

}  // namespace

GatheredFrame gather_frame(const PerspectiveView& view, const SplatRule& rule,
                           const RayVisibility& rays, std::span<const SplatChunk* const> stored,
                           const Progress& progress) {
  return FrameGatherer(view, rule, rays, stored).gather(progress);
}

}  // namespace tenku
