#include "view/shading_points.h"

#include <atomic>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"

namespace tenku {
namespace {

constexpr int kRaysPerPixel = static_cast<int>(kRayPlaces.size());
constexpr int kMostMirrors = 4;

struct Point {
  Vec3 position, sum, normal;  ///< the sum of all positions
  std::uint32_t material, triangle;
  std::uint64_t surface;
  Rgb weight;
  int rays;
  bool direct;
};

struct PixelPoints {
  std::array<Point, kRaysPerPixel> point;
  int count = 0;
  Rgb background{};
};

/// Equal for triangles of one object in one plane, told by its normal and its offset.
std::uint64_t surface_key(const RayVisibility& rays, std::uint32_t triangle, Vec3 normal) {
  const TriangleSoup& soup = rays.soup();
  const double offset = dot(normal, soup.vertices[soup.triangles[triangle][0]]);
  return mix_rounded(mix_bits(soup.object[triangle]),
                     {100.0 * normal.x, 100.0 * normal.y, 100.0 * normal.z, 5.0 * offset});
}

class PixelTracer {
 public:
  PixelTracer(const RayVisibility& rays, const Backdrop& backdrop)
      : rays_(rays), backdrop_(backdrop) {}

  void trace(Vec3 origin, Vec3 direction, PixelPoints& pixel) {
    Rgb weight = Rgb::grey(1.0 / kRaysPerPixel);
    for (int mirrors = 0;; ++mirrors) {
      ++sent;
      const auto hit = rays_.first_hit(origin, direction);
      const double reach = hit ? hit->distance_m : std::numeric_limits<double>::infinity();
      weight = rays_.glass_transmission(origin, direction, reach) * weight;
      if (!hit) {
        pixel.background = pixel.background + weight * backdrop_.colour(direction);
        return;
      }
      const Vec3 face = rays_.normal(hit->triangle);
      const Vec3 normal = dot(face, direction) < 0.0 ? face : -face;
      const std::uint32_t index = rays_.soup().material[hit->triangle];
      const Vec3 position = rays_.on_plane(hit->triangle, origin + hit->distance_m * direction);
      add({position, position, normal, index, hit->triangle,
           surface_key(rays_, hit->triangle, normal), weight, 1, mirrors == 0},
          pixel);
      const double mirror = rays_.materials()[index].mirror;
      if (!(mirror > 0.0) || mirrors == kMostMirrors) return;
      // Schlick's rise of the reflectance toward grazing incidence.
      const double away = 1.0 + dot(normal, direction);
      weight = (mirror + (1.0 - mirror) * std::pow(away, 5.0)) * weight;
      origin = position + rays_.lift_m() * normal;
      direction = direction - 2.0 * dot(direction, normal) * normal;
      if (pixel.count == kRaysPerPixel) return;
    }
  }

  void move_to_middles(Vec3 eye, PixelPoints& pixel) {
    for (int k = 0; k < pixel.count; ++k) {
      Point& point = pixel.point[static_cast<std::size_t>(k)];
      if (point.rays == 1 || !point.direct) continue;
      const Vec3 middle = (1.0 / point.rays) * point.sum;
      ++sent;
      const auto hit = rays_.first_hit(eye, normalized(middle - eye));
      if (!hit) continue;
      const Vec3 face = rays_.normal(hit->triangle);
      const Vec3 normal = dot(face, point.normal) > 0.0 ? face : -face;
      if (surface_key(rays_, hit->triangle, normal) == point.surface) point.position = middle;
    }
  }

  std::uint64_t sent = 0;

 private:
  static void add(const Point& point, PixelPoints& pixel) {
    for (int k = 0; k < pixel.count; ++k) {
      Point& known = pixel.point[static_cast<std::size_t>(k)];
      if (known.surface != point.surface || known.direct != point.direct) continue;
      known.weight = known.weight + point.weight;
      known.sum = known.sum + point.sum;
      ++known.rays;
      return;
    }
    if (pixel.count < kRaysPerPixel) pixel.point[static_cast<std::size_t>(pixel.count++)] = point;
  }

  const RayVisibility& rays_;
  const Backdrop& backdrop_;
};

void append(const PixelPoints& pixel, std::uint32_t index, ShadingPoints& points) {
  for (int k = 0; k < pixel.count; ++k) {
    const Point& point = pixel.point[static_cast<std::size_t>(k)];
    points.sensors.position.push_back(point.position);
    points.sensors.normal.push_back(point.normal);
    points.pixel_index.push_back(index);
    points.material.push_back(point.material);
    points.triangle.push_back(point.triangle);
    points.surface.push_back(point.surface);
    points.weight.push_back(point.weight);
    points.coverage.push_back(static_cast<double>(point.rays) / kRaysPerPixel);
    points.is_seen_directly.push_back(point.direct);
  }
  points.background.push_back(pixel.background);
  points.first.push_back(static_cast<std::uint32_t>(points.sensors.size()));
}

}  // namespace

ShadingPoints find_shading_points(const PerspectiveCamera& camera, const RayVisibility& rays,
                                  const Backdrop& backdrop, PointPlace place, Progress& progress) {
  const auto width = static_cast<std::size_t>(camera.width());
  const auto height = static_cast<std::size_t>(camera.height());
  std::vector<PixelPoints> pixels(width * height);
  std::atomic<std::uint64_t> sent{0};
  progress.begin("view rays", height);
  parallel_for(height, 4, [&](IndexRange rows) {
    progress.stop_if_cancelled();
    PixelTracer tracer(rays, backdrop);
    for (std::size_t y = rows.begin; y < rows.end; ++y) {
      for (std::size_t x = 0; x < width; ++x) {
        for (const auto& [dx, dy] : kRayPlaces) {
          const Vec3 direction =
              camera.ray(static_cast<double>(x) + dx, static_cast<double>(y) + dy);
          tracer.trace(camera.eye(), direction, pixels[y * width + x]);
        }
        if (place == PointPlace::Middle) {
          tracer.move_to_middles(camera.eye(), pixels[y * width + x]);
        }
      }
    }
    sent += tracer.sent;
    progress.advance(rows.end - rows.begin);
  });
  ShadingPoints points;
  points.width = camera.width();
  points.rays = sent;
  points.first.push_back(0);
  for (std::size_t p = 0; p < pixels.size(); ++p) {
    append(pixels[p], static_cast<std::uint32_t>(p), points);
  }
  progress.end(std::to_string(points.sensors.size()) + " points to light");
  return points;
}

}  // namespace tenku
