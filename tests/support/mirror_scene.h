/// Scenes of mirrors, and rays that are followed through them without any of the code under test.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "beams/beam_tree.h"

namespace tenku::testing_support {

/// Triangles put together by hand; material 0 is grey, 1 a mirror.
struct MirrorScene {
  TriangleSoup soup;
  std::vector<Material> materials{{}, {}};

  MirrorScene() {
    materials[1].mirror = 0.8;
    materials[1].reflectance = Rgb::grey(0.05);
  }

  void fan(const std::vector<Vec3>& corners, std::uint32_t material, std::uint32_t object = 0) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), corners.begin(), corners.end());
    for (std::uint32_t k = 1; k + 1 < corners.size(); ++k) {
      soup.triangles.push_back({first, first + k, first + k + 1});
      soup.object.push_back(object);
      soup.surface_type.push_back(SurfaceType::Unknown);
      soup.material.push_back(material);
    }
  }

  /// A rectangle about `middle`, its half sides `a` and `b`.
  void rectangle(Vec3 middle, Vec3 a, Vec3 b, std::uint32_t material) {
    fan({middle - a - b, middle + a - b, middle + a + b, middle - a + b}, material);
  }

  void box(Vec3 low, Vec3 high, std::uint32_t material) {
    const auto [x, y, z] = low;
    const auto [a, b, c] = high;
    fan({{x, y, z}, {x, b, z}, {a, b, z}, {a, y, z}}, material);
    fan({{x, y, c}, {a, y, c}, {a, b, c}, {x, b, c}}, material);
    fan({{x, y, z}, {a, y, z}, {a, y, c}, {x, y, c}}, material);
    fan({{a, y, z}, {a, b, z}, {a, b, c}, {a, y, c}}, material);
    fan({{a, b, z}, {x, b, z}, {x, b, c}, {a, b, c}}, material);
    fan({{x, b, z}, {x, y, z}, {x, y, c}, {x, b, c}}, material);
  }

  BeamFaces faces() const { return BeamFaces(soup, materials); }
};

/// The way of one ray: triangles of mirrors, the triangle it ends at, and where it goes from there.
struct FollowedRay {
  std::vector<std::uint32_t> mirrors;
  std::optional<std::uint32_t> end;
  Vec3 direction;
};

/// Distance to a triangle along a ray, by barycentric coordinates.
///
/// Source  T. Moeller and B. Trumbore, "Fast, minimum storage ray-triangle intersection", 1997.
inline double distance_to(const TriangleSoup& soup, std::uint32_t t, Vec3 origin, Vec3 direction) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const Vec3 a = soup.vertices[soup.triangles[t][0]];
  const Vec3 e1 = soup.vertices[soup.triangles[t][1]] - a,
             e2 = soup.vertices[soup.triangles[t][2]] - a;
  const Vec3 p = cross(direction, e2);
  const double det = dot(e1, p);
  if (det == 0.0) return kNone;
  const Vec3 s = origin - a, q = cross(s, e1);
  const double u = dot(s, p) / det, v = dot(direction, q) / det;
  if (u < 0.0 || v < 0.0 || u + v > 1.0) return kNone;
  return dot(e2, q) / det;
}

inline FollowedRay follow(const MirrorScene& scene, Vec3 origin, Vec3 direction, int depth) {
  FollowedRay way;
  double least = -std::numeric_limits<double>::infinity();
  for (;;) {
    double nearest = std::numeric_limits<double>::infinity();
    way.end.reset();
    for (std::uint32_t t = 0; t < scene.soup.size(); ++t) {
      const double at = distance_to(scene.soup, t, origin, direction);
      if (at > std::max(least, -1e300) && at < nearest) nearest = at, way.end = t;
    }
    way.direction = direction;
    if (!way.end || !(scene.materials[scene.soup.material[*way.end]].mirror > 0.0)) return way;
    if (static_cast<int>(way.mirrors.size()) == depth) return way;
    way.mirrors.push_back(*way.end);
    const auto& [i, j, k] = scene.soup.triangles[*way.end];
    const Vec3 n = normalized(cross(scene.soup.vertices[j] - scene.soup.vertices[i],
                                    scene.soup.vertices[k] - scene.soup.vertices[i]));
    origin = origin + nearest * direction;
    direction = direction - 2.0 * dot(direction, n) * n;
    least = 1e-9;
  }
}

inline bool is_inside(const BeamRegion& region, WindowPoint p, double slack) {
  for (std::size_t k = 0; k < region.corners.size(); ++k) {
    const WindowPoint a = region.corners[k], b = region.corners[(k + 1) % region.corners.size()];
    const double du = b.u - a.u, dv = b.v - a.v;
    if (du * (p.v - a.v) - dv * (p.u - a.u) < -slack * std::hypot(du, dv)) return false;
  }
  return true;
}

inline double area_of(const std::vector<WindowPoint>& corners) {
  double sum = 0.0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const WindowPoint a = corners[k], b = corners[(k + 1) % corners.size()];
    sum += 0.5 * (a.u * b.v - a.v * b.u);
  }
  return sum;
}

}  // namespace tenku::testing_support
