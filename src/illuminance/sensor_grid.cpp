#include "illuminance/sensor_grid.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/random.h"

namespace tenku {
namespace {

constexpr double kInset = 0.02;  // of the way from a corner to the middle of its part
constexpr std::size_t kMostSensors = 50'000'000;

struct Corners {
  Vec3 a, b, c;

  Vec3 at(double u, double v) const { return a + u * (b - a) + v * (c - a); }
  Vec3 middle() const { return (1.0 / 3.0) * (a + b + c); }
  double longest_side() const { return std::max({length(b - a), length(c - b), length(a - c)}); }
};

/// How far a point lies inside the four sides of a square, metres.
std::array<double, 4> depths(Vec3 p, const GroundSquare& square) {
  return {square.half_m - (p.x - square.x), square.half_m + (p.x - square.x),
          square.half_m - (p.y - square.y), square.half_m + (p.y - square.y)};
}

bool is_inside(const Corners& triangle, const GroundSquare& square) {
  const std::array<Vec3, 3> corners{triangle.a, triangle.b, triangle.c};
  return std::all_of(corners.begin(), corners.end(), [&](Vec3 corner) {
    const auto depth = depths(corner, square);
    return *std::min_element(depth.begin(), depth.end()) >= 0.0;
  });
}

/// Source  I. E. Sutherland and G. W. Hodgman, "Reentrant polygon clipping", CACM 17(1), 1974.
std::vector<Vec3> cut(const Corners& triangle, const GroundSquare& square) {
  std::vector<Vec3> polygon{triangle.a, triangle.b, triangle.c};
  for (std::size_t side = 0; side < 4; ++side) {
    std::vector<Vec3> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec3 p = polygon[k], q = polygon[(k + 1) % polygon.size()];
      const double of_p = depths(p, square)[side], of_q = depths(q, square)[side];
      if (of_p >= 0.0) kept.push_back(p);
      if ((of_p >= 0.0) != (of_q >= 0.0)) kept.push_back(p + (of_p / (of_p - of_q)) * (q - p));
    }
    polygon = std::move(kept);
  }
  return polygon;
}

/// Adds the sensors and parts of one triangle.
class GridBuilder {
 public:
  GridBuilder(SensorGrid& grid, double spacing_m) : grid_(grid), spacing_(spacing_m) {}

  void add(std::uint32_t triangle, SurfaceType type, const Corners& corners) {
    const Vec3 twice_area = cross(corners.b - corners.a, corners.c - corners.a);
    const double area = 0.5 * length(twice_area);
    if (!(area > 0.0)) return;
    normal_ = normalized(twice_area);
    type_ = type;
    triangle_ = triangle;
    const double parts = std::ceil(corners.longest_side() / spacing_);
    if (grid_.sensors.size() + 0.5 * parts * parts > kMostSensors) {
      throw InputError("a spacing of " + std::to_string(spacing_) +
                       " m gives over 50 million sensors; choose a wider one");
    }
    if (parts <= 1.0) {
      add_single(corners, area);
    } else {
      add_divided(corners, area, static_cast<std::uint32_t>(parts));
    }
  }

 private:
  std::uint32_t add_sensor(Vec3 position, double area) {
    grid_.sensors.position.push_back(position);
    grid_.sensors.normal.push_back(normal_);
    grid_.area_m2.push_back(area);
    grid_.type.push_back(type_);
    return static_cast<std::uint32_t>(grid_.sensors.size() - 1);
  }

  void add_part(std::array<std::uint32_t, 3> sensors, std::array<Vec3, 3> points) {
    grid_.corner_sensor.push_back(sensors);
    grid_.corner_point.push_back(points);
    grid_.triangle.push_back(triangle_);
  }

  void add_single(const Corners& corners, double area) {
    const Vec3 m = corners.middle();
    const std::uint64_t key = mix_rounded(static_cast<std::uint64_t>(type_),
                                          {m.x / spacing_, m.y / spacing_, m.z / spacing_,
                                           8.0 * normal_.x, 8.0 * normal_.y, 8.0 * normal_.z});
    const auto [found, is_new] =
        grid_.shared.emplace(key, static_cast<std::uint32_t>(grid_.sensors.size()));
    const std::uint32_t sensor = found->second;
    if (is_new) {
      add_sensor(m, area);
    } else {
      grid_.area_m2[sensor] += area;
    }
    add_part({sensor, sensor, sensor}, {corners.a, corners.b, corners.c});
  }

  void add_divided(const Corners& corners, double area, std::uint32_t n) {
    const auto first = static_cast<std::uint32_t>(grid_.sensors.size());
    const auto index = [&](std::uint32_t i, std::uint32_t j) {  // row j holds n + 1 - j points
      return first + j * (n + 1) - j * (j - 1) / 2 + i;
    };
    const auto point = [&](std::uint32_t i, std::uint32_t j) {
      return corners.at(static_cast<double>(i) / n, static_cast<double>(j) / n);
    };
    const Vec3 middle = corners.middle();
    for (std::uint32_t j = 0; j <= n; ++j) {
      for (std::uint32_t i = 0; i + j <= n; ++i) {
        // A corner of the whole stands for one part, a side for three, the inside for six.
        const int sides = (i == 0) + (j == 0) + (i + j == n);
        const double share = sides == 0 ? 6.0 : sides == 1 ? 3.0 : 1.0;
        const Vec3 corner = point(i, j);
        const Vec3 inward = (kInset * 3.0 / n) * (middle - corner);
        add_sensor(sides == 0 ? corner : corner + inward, area * share / (3.0 * n * n));
      }
    }
    for (std::uint32_t j = 0; j < n; ++j) {
      for (std::uint32_t i = 0; i + j < n; ++i) {
        add_part({index(i, j), index(i + 1, j), index(i, j + 1)},
                 {point(i, j), point(i + 1, j), point(i, j + 1)});
        if (i + j + 1 >= n) continue;
        add_part({index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)},
                 {point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
      }
    }
  }

  SensorGrid& grid_;
  double spacing_;
  Vec3 normal_{};
  SurfaceType type_ = SurfaceType::Unknown;
  std::uint32_t triangle_ = 0;
};

}  // namespace

void append_sensors(SensorGrid& grid, const TriangleSoup& soup,
                    std::span<const std::uint32_t> triangles, double spacing_m,
                    const GroundSquare* within) {
  if (!(spacing_m > 0.0) || !std::isfinite(spacing_m)) {
    throw InputError("a spacing of " + std::to_string(spacing_m) + " m is not positive");
  }
  GridBuilder builder(grid, spacing_m);
  for (const std::uint32_t t : triangles) {
    const auto& [a, b, c] = soup.triangles[t];
    const Corners whole{soup.vertices[a], soup.vertices[b], soup.vertices[c]};
    const SurfaceType type = soup.surface_type[t];
    if (within == nullptr || is_inside(whole, *within)) {
      builder.add(t, type, whole);
      continue;
    }
    const std::vector<Vec3> part = cut(whole, *within);
    for (std::size_t k = 2; k < part.size(); ++k) {
      builder.add(t, type, {part[0], part[k - 1], part[k]});
    }
  }
}

}  // namespace tenku
