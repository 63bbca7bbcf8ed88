#include "visibility/crossing_faces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/parallel.h"
#include "scene/geometry_checks.h"

namespace tenku {
namespace {

constexpr std::size_t kGrain = 256;
constexpr std::uint32_t kNoObject = MeshAdjacency::kNone;
constexpr int kMostMet = 16;       // faces along one edge
constexpr double kSlant = 1e-3;    // sine of the angle of edge and face
constexpr double kTouching = 2.0;  // lifts from the ends that still count as touching

struct Crossing {
  Vec3 place;
  std::uint32_t other = kNoObject;  ///< object
};

/// Whether a point of a triangle lies by its border, where others may touch it.
bool is_by_border(const TriangleSoup& soup, std::uint32_t triangle, Vec3 point, double margin) {
  const auto& corner = soup.triangles[triangle];
  for (unsigned e = 0; e < 3; ++e) {
    const Vec3 a = soup.vertices[corner[e]], along = soup.vertices[corner[(e + 1) % 3]] - a;
    if (length(cross(along, point - a)) <= margin * length(along)) return true;
  }
  return false;
}

/// Where an edge of an object passes through another.
Crossing along_edge(const RayVisibility& rays, std::uint32_t object, Vec3 a, Vec3 b) {
  const double whole = length(b - a), margin = kTouching * rays.lift_m();
  if (!(whole > 2.0 * margin)) return {};
  const Vec3 along = (1.0 / whole) * (b - a);
  double at = margin;
  for (int k = 0; k < kMostMet; ++k) {
    const auto hit = rays.first_hit(a + at * along, along);
    if (!hit || at + hit->distance_m > whole - margin) return {};
    at += hit->distance_m;
    const std::uint32_t other = rays.soup().object[hit->triangle];
    const bool is_through = std::abs(dot(rays.normal(hit->triangle), along)) > kSlant;
    const Vec3 place = a + at * along;
    if (other != object && is_through && !is_by_border(rays.soup(), hit->triangle, place, margin)) {
      return {place, other};
    }
    at += margin;
  }
  return {};
}

}  // namespace

std::optional<Finding> crossing_faces(const Scene& scene, const RayVisibility& rays) {
  const TriangleSoup& soup = rays.soup();
  std::vector<Crossing> found(soup.size());
  parallel_for(soup.size(), kGrain, [&](IndexRange range) {
    for (auto t = static_cast<std::uint32_t>(range.begin); t < range.end; ++t) {
      for (unsigned e = 0; e < 3 && found[t].other == kNoObject; ++e) {
        const std::uint32_t opposite = rays.adjacency().opposite(t, e);
        if (opposite != MeshAdjacency::kNone && opposite < 3 * t + e)
          continue;  // asked from its other side
        const auto& corner = soup.triangles[t];
        found[t] = along_edge(rays, soup.object[t], soup.vertices[corner[e]],
                              soup.vertices[corner[(e + 1) % 3]]);
      }
    }
  });
  const auto is_met = [](const Crossing& c) { return c.other != kNoObject; };
  const auto first = std::find_if(found.begin(), found.end(), is_met);
  if (first == found.end()) return std::nullopt;
  const auto t = static_cast<std::size_t>(first - found.begin());
  return Finding{
      "faces_cross",
      Severity::Note,
      scene.objects[soup.object[t]].id,
      place_in_file(scene, first->place),
      "faces pass through those of another object (first: [" + scene.objects[first->other].id +
          "]): elements and points across the cut hold light of both its sides, and may be off by "
          "more than their errors tell",
      "cut the faces where they meet, or make the elements small (--size-max)",
      static_cast<std::size_t>(std::count_if(first, found.end(), is_met))};
}

}  // namespace tenku
