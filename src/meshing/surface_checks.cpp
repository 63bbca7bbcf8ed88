#include "meshing/surface_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/extent.h"
#include "core/parallel.h"
#include "meshing/element_tree.h"

namespace tenku {
namespace {

constexpr double kGap_m = 0.01, kGapOfExtent = 1.0 / 500.0;
constexpr double kSlender = 100.0;
constexpr double kFloatStep = 0x1.0p-23, kLeastSteps = 32.0;

double largest_coordinate(Vec3 p) {
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

class Checks {
 public:
  Checks(const std::vector<FlatPolygon>& polygons, const ElementMesh& mesh,
         std::span<const std::uint32_t> polygon_of, const JoinTolerance& tolerance)
      : polygons_(polygons),
        mesh_(mesh),
        polygon_of_(polygon_of),
        tolerance_(tolerance),
        tree_(mesh),
        gap_m_(std::min(kGap_m, kGapOfExtent * extent_of(mesh.vertices).longest_side())) {}

  std::vector<SurfaceFlaw> flaws() const {
    std::vector<std::optional<SurfaceFlaw>> of_polygon(polygons_.size());
    std::vector<std::optional<SurfaceFlaw>> gap(polygons_.size());
    parallel_for(polygons_.size(), 32, [&](IndexRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i) {
        of_polygon[i] = sliver(polygons_[i]);
        gap[i] = gap_at(static_cast<std::uint32_t>(i));
      }
    });
    std::vector<std::optional<SurfaceFlaw>> of_element(mesh_.size());
    parallel_for(mesh_.size(), 256, [&](IndexRange range) {
      for (std::size_t e = range.begin; e < range.end; ++e) {
        of_element[e] = overlap(static_cast<std::uint32_t>(e));
      }
    });
    std::vector<SurfaceFlaw> found;
    for (const auto* list : {&of_polygon, &gap}) {
      for (const auto& flaw : *list) {
        if (flaw) found.push_back(*flaw);
      }
    }
    append_overlaps(of_element, found);
    if (const auto flaw = coarsest()) found.push_back(*flaw);
    return found;
  }

 private:
  /// One flaw for each polygon that lies on others.
  void append_overlaps(const std::vector<std::optional<SurfaceFlaw>>& of_element,
                       std::vector<SurfaceFlaw>& found) const {
    std::uint32_t last = kNone;
    for (std::size_t e = 0; e < of_element.size(); ++e) {
      if (!of_element[e] || polygon_of_[e] == last) continue;
      last = polygon_of_[e];
      found.push_back(*of_element[e]);
    }
  }

  static std::optional<SurfaceFlaw> sliver(const FlatPolygon& polygon) {
    double around = 0.0;
    for (const auto& ring : polygon.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        around += length(ring[(i + 1) % ring.size()] - ring[i]);
      }
    }
    const double width = 2.0 * polygon.area_m2 / around;
    if (0.5 * around < kSlender * width) return std::nullopt;
    return SurfaceFlaw{SurfaceFlaw::Kind::Sliver, polygon.object, polygon.origin, width};
  }

  /// Nearest element of another polygon, or one on which `p` lies; none if none is in reach.
  std::optional<ElementTree::Near> nearest_other(Vec3 p, std::uint32_t polygon) const {
    std::optional<ElementTree::Near> nearest;
    double reach_m = gap_m_;
    tree_.for_each_near(p, gap_m_, [&](const ElementTree::Near& n) {
      if (polygon_of_[n.element] == polygon) return reach_m;
      nearest = n;
      reach_m = lies_on(n) ? -1.0 : n.distance_m;
      return reach_m;
    });
    return nearest;
  }

  bool lies_on(const ElementTree::Near& n) const {
    return n.distance_m <= 2.0 * tolerance_.plane_m;
  }

  /// The nearest that an edge stops before, along three quarters of its length at least.
  std::optional<ElementTree::Near> gap_along(Vec3 a, Vec3 b, std::uint32_t polygon) const {
    constexpr std::array<double, 4> kSamples{0.1, 0.85, 0.35, 0.6};
    std::optional<ElementTree::Near> nearest;
    int closed = 0;
    for (const double t : kSamples) {
      const auto other = nearest_other(a + t * (b - a), polygon);
      if (!other || lies_on(*other)) {
        if (++closed > 1) return std::nullopt;
      } else if (!nearest || other->distance_m < nearest->distance_m) {
        nearest = other;
      }
    }
    return nearest;
  }

  /// The first edge of a polygon that stops short of another.
  std::optional<SurfaceFlaw> gap_at(std::uint32_t number) const {
    const FlatPolygon& polygon = polygons_[number];
    for (const auto& ring : polygon.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec3 a = ring[i], b = ring[(i + 1) % ring.size()];
        if (length(b - a) < 10.0 * gap_m_) continue;
        if (const auto near = gap_along(a, b, number)) {
          return SurfaceFlaw{SurfaceFlaw::Kind::Gap, polygon.object, 0.5 * (a + b),
                             near->distance_m, mesh_.object[near->element]};
        }
      }
    }
    return std::nullopt;
  }

  /// Whether an element's centre lies on another polygon.
  std::optional<SurfaceFlaw> overlap(std::uint32_t element) const {
    constexpr double kTan = 1e-3;
    const Vec3 centre = mesh_.centre(element), area = mesh_.doubled_area(element);
    const double reach_m = 2.0 * tolerance_.weld_m;
    std::optional<SurfaceFlaw> found;
    tree_.for_each_near(centre, reach_m, [&](const ElementTree::Near& n) {
      if (polygon_of_[n.element] == polygon_of_[element]) return reach_m;
      const Vec3 other = mesh_.doubled_area(n.element);
      if (length(cross(area, other)) > kTan * std::abs(dot(area, other))) return reach_m;
      found = SurfaceFlaw{SurfaceFlaw::Kind::Overlap, mesh_.object[element], centre, 0.0,
                          mesh_.object[n.element]};
      return -1.0;
    });
    return found;
  }

  /// The element that is narrowest for its distance from the origin, if it is too narrow.
  std::optional<SurfaceFlaw> coarsest() const {
    double least = kLeastSteps;
    std::optional<SurfaceFlaw> found;
    for (std::size_t e = 0; e < mesh_.size(); ++e) {
      const auto& [a, b, c] = mesh_.elements[e];
      const Vec3 p = mesh_.vertices[a], q = mesh_.vertices[b], r = mesh_.vertices[c];
      const double longest = std::max({length(q - p), length(r - q), length(p - r)});
      const double width = length(mesh_.doubled_area(e)) / longest;
      const double steps = width / (kFloatStep * largest_coordinate(p));
      if (!(steps < least)) continue;
      least = steps;
      found = SurfaceFlaw{SurfaceFlaw::Kind::Coarse, mesh_.object[e], p, width};
    }
    return found;
  }

  const std::vector<FlatPolygon>& polygons_;
  const ElementMesh& mesh_;
  std::span<const std::uint32_t> polygon_of_;
  JoinTolerance tolerance_;
  ElementTree tree_;
  double gap_m_;
};

}  // namespace

std::vector<SurfaceFlaw> check_surfaces(const std::vector<FlatPolygon>& polygons,
                                        const ElementMesh& mesh,
                                        std::span<const std::uint32_t> polygon_of,
                                        const JoinTolerance& tolerance) {
  if (mesh.size() == 0) return {};
  return Checks(polygons, mesh, polygon_of, tolerance).flaws();
}

}  // namespace tenku
