#include "flythrough/closest_approach.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"

namespace tenku {
namespace {

/// A frame's eye, and the width of a pixel at distance 1.
struct Station {
  Vec3 eye;
  double pixel;
};

/// Distance from a box; zero inside.
double distance_from(const Extent& box, Vec3 p) {
  const auto beyond = [](double low, double high, double v) {
    return std::max({low - v, v - high, 0.0});
  };
  return length({beyond(box.min.x, box.max.x, p.x), beyond(box.min.y, box.max.y, p.y),
                 beyond(box.min.z, box.max.z, p.z)});
}

/// Frames that can be the closest to some point of the box: those whose least distance from it is
/// no more than the greatest that the best has.
std::vector<Station> stations_near(const Extent& box, const CameraPath& path) {
  std::vector<Station> all, near;
  double limit = std::numeric_limits<double>::infinity();
  for (const CameraFrame& f : path.frames) {
    all.push_back({f.eye, 2.0 * std::tan(0.5 * f.horizontal_fov.in_radians()) / path.width});
    limit = std::min(limit,
                     (length(f.eye - box.middle()) + 0.5 * length(box.size())) * all.back().pixel);
  }
  for (const Station& s : all) {
    if (distance_from(box, s.eye) * s.pixel <= limit) near.push_back(s);
  }
  return near;
}

}  // namespace

std::vector<double> pixels_at_closest(const StoredPoints& points, const CameraPath& path,
                                      const SplatRule& rule) {
  std::vector<double> pixels(points.size());
  if (points.empty()) return pixels;
  const std::vector<Station> stations = stations_near(points.extent(), path);
  parallel_for(points.size(), 256, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      double finest = std::numeric_limits<double>::infinity();
      for (const Station& s : stations) {
        finest = std::min(finest, s.pixel * length(points.position[i] - s.eye));
      }
      pixels[i] = std::min(points.footprint_m[i] / finest, rule.coarsest(points.is_edge[i] != 0));
    }
  });
  return pixels;
}

}  // namespace tenku
