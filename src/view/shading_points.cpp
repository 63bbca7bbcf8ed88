#include "view/shading_points.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"

namespace tenku {
namespace {

constexpr double kSeen = 1e-3;  ///< of a pixel's light: less is no step of a picture's 256
constexpr int kRaysPerPixel = static_cast<int>(kRayPlaces.size());

/// Those rays of a pixel that met one surface of one material by the same way.
struct Point {
  PathPoint first;
  Vec3 sum;  ///< of all positions
  std::uint64_t surface;
  Rgb weight;
  int rays;
};

/// Equal for triangles of one object in one plane, told by its normal and its offset.
std::uint64_t surface_key(const RayVisibility& rays, std::uint32_t triangle, Vec3 normal) {
  const TriangleSoup& soup = rays.soup();
  const double offset = dot(normal, soup.vertices[soup.triangles[triangle][0]]);
  return mix_rounded(mix_bits(soup.object[triangle]),
                     {100.0 * normal.x, 100.0 * normal.y, 100.0 * normal.z, 5.0 * offset});
}

/// Points of some rows of the picture.
struct RowPoints {
  std::vector<Point> points;
  std::vector<std::uint32_t> count;  ///< [pixel]
  std::vector<Rgb> background;       ///< [pixel]
  std::uint64_t rays = 0;
  std::size_t cut_pixels = 0;
  double cut_share = 0.0;
};

class PixelTracer {
 public:
  PixelTracer(const PixelPaths& paths, const RayVisibility& rays, Vec3 eye, PointPlace place)
      : paths_(paths), rays_(rays), eye_(eye), place_(place) {}

  void trace(int x, int y, RowPoints& rows) {
    if (const auto alone = paths_.background_alone(x, y)) {
      rows.count.push_back(0);
      rows.background.push_back(*alone);
      return;
    }
    const std::size_t begin = rows.points.size();
    Rgb background{};
    double cut = 0.0;
    for (std::size_t s = 0; s < kRayPlaces.size(); ++s) {
      path_.clear();
      paths_.follow(x, y, s, path_);
      background = background + path_.background;
      cut = std::max(cut, path_.cut_share);
      for (const PathPoint& point : path_.points) add(point, begin, rows.points);
    }
    if (place_ == PointPlace::Middle) {
      for (std::size_t k = begin; k < rows.points.size(); ++k) move_to_middle(rows.points[k]);
    }
    rows.count.push_back(static_cast<std::uint32_t>(rows.points.size() - begin));
    rows.background.push_back(1.0 / kRaysPerPixel * background);
    rows.cut_pixels += cut > kSeen;
    rows.cut_share = std::max(rows.cut_share, cut);
  }

  std::uint64_t sent() const { return path_.rays; }

 private:
  void add(const PathPoint& point, std::size_t begin, std::vector<Point>& points) {
    const std::uint64_t surface = surface_key(rays_, point.triangle, point.normal);
    const Rgb weight = 1.0 / kRaysPerPixel * point.weight;
    for (std::size_t k = begin; k < points.size(); ++k) {
      Point& known = points[k];
      if (known.surface != surface || known.first.way != point.way) continue;
      if (material(known.first.triangle) != material(point.triangle)) continue;  // window, wall
      known.weight = known.weight + weight;
      known.sum = known.sum + point.position;
      ++known.rays;
      return;
    }
    points.push_back({point, point.position, surface, weight, 1});
  }

  void move_to_middle(Point& point) {
    if (point.rays == 1 || point.first.way != 0) return;
    const Vec3 middle = (1.0 / point.rays) * point.sum;
    ++path_.rays;
    const auto hit = rays_.first_hit(eye_, normalized(middle - eye_));
    if (!hit) return;
    const Vec3 face = rays_.normal(hit->triangle);
    const Vec3 normal = dot(face, point.first.normal) > 0.0 ? face : -face;
    if (surface_key(rays_, hit->triangle, normal) == point.surface) point.first.position = middle;
  }

  std::uint32_t material(std::uint32_t triangle) const { return rays_.soup().material[triangle]; }

  const PixelPaths& paths_;
  const RayVisibility& rays_;
  Vec3 eye_;
  PointPlace place_;
  PixelPath path_;
};

void append(const RowPoints& rows, const RayVisibility& rays, ShadingPoints& points) {
  std::size_t k = 0;
  for (std::size_t p = 0; p < rows.count.size(); ++p) {
    const auto pixel = static_cast<std::uint32_t>(points.background.size());
    for (std::uint32_t n = 0; n < rows.count[p]; ++n, ++k) {
      const Point& point = rows.points[k];
      points.sensors.position.push_back(point.first.position);
      points.sensors.normal.push_back(point.first.normal);
      points.pixel_index.push_back(pixel);
      points.material.push_back(rays.soup().material[point.first.triangle]);
      points.triangle.push_back(point.first.triangle);
      points.surface.push_back(point.surface);
      points.weight.push_back(point.weight);
      points.coverage.push_back(static_cast<double>(point.rays) / kRaysPerPixel);
      points.is_seen_directly.push_back(point.first.way == 0);
    }
    points.background.push_back(rows.background[p]);
    points.first.push_back(static_cast<std::uint32_t>(points.sensors.size()));
  }
  points.rays += rows.rays;
  points.cut_pixels += rows.cut_pixels;
  points.cut_share = std::max(points.cut_share, rows.cut_share);
}

}  // namespace

std::vector<Vec3> places_of_rays(const ShadingPoints& points, std::size_t point,
                                 const PixelPaths& paths, const RayVisibility& rays) {
  const auto [x, y] = points.pixel(point);
  std::vector<Vec3> places;
  if (!points.is_seen_directly[point]) return places;
  PixelPath path;
  for (std::size_t s = 0; s < kRayPlaces.size(); ++s) {
    path.clear();
    paths.follow(x, y, s, path);
    for (const PathPoint& met : path.points) {
      const bool is_same = met.way == 0 &&
                           rays.soup().material[met.triangle] == points.material[point] &&
                           surface_key(rays, met.triangle, met.normal) == points.surface[point];
      if (is_same) places.push_back(met.position);
    }
  }
  return places;
}

ShadingPoints find_shading_points(const PerspectiveCamera& camera, const RayVisibility& rays,
                                  const PixelPaths& paths, PointPlace place, Progress& progress) {
  constexpr std::size_t kRows = 4;
  const auto height = static_cast<std::size_t>(camera.height());
  std::vector<RowPoints> rows((height + kRows - 1) / kRows);
  progress.begin("view rays", height);
  const auto trace_rows = [&](std::size_t block) {
    progress.stop_if_cancelled();
    PixelTracer tracer(paths, rays, camera.eye(), place);
    RowPoints& made = rows[block];
    const std::size_t begin = block * kRows, end = std::min(height, begin + kRows);
    const std::size_t pixels = (end - begin) * static_cast<std::size_t>(camera.width());
    made.count.reserve(pixels);
    made.background.reserve(pixels);
    for (std::size_t y = begin; y < end; ++y) {
      for (int x = 0; x < camera.width(); ++x) tracer.trace(x, static_cast<int>(y), made);
    }
    made.rays += tracer.sent();
    progress.advance(end - begin);
  };
  parallel_for(rows.size(), 1, [&](IndexRange blocks) {
    for (std::size_t block = blocks.begin; block < blocks.end; ++block) trace_rows(block);
  });
  ShadingPoints points;
  points.width = camera.width();
  points.first.push_back(0);
  for (const RowPoints& some : rows) append(some, rays, points);
  progress.end(std::to_string(points.sensors.size()) + " points to light");
  return points;
}

}  // namespace tenku
