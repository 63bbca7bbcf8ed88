#include "form_factors/target_edges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace tenku {
namespace {

using Triangle = std::array<Vec3, 3>;

Vec3 centre_of(std::span<const Vec3> corner) {
  Vec3 sum{};
  for (const Vec3& c : corner) sum = sum + c;
  return (1.0 / static_cast<double>(corner.size())) * sum;
}

double extent_along(std::span<const Vec3> corner, Vec3 direction) {
  double low = dot(corner[0], direction), high = low;
  for (const Vec3& c : corner) {
    low = std::min(low, dot(c, direction)), high = std::max(high, dot(c, direction));
  }
  return high - low;
}

Vec3 nearest_on_edge(Vec3 point, Vec3 a, Vec3 b) {
  const Vec3 along = b - a;
  return a + std::clamp(dot(point - a, along) / dot(along, along), 0.0, 1.0) * along;
}

/// Distance between two edges: where both are nearest inside, or from one of the four ends.
double distance_of_edges(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Vec3 u = b - a, v = d - c, w = c - a;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), sine2 = uu * vv - uv * uv;
  if (sine2 > 1e-12 * uu * vv) {
    const double s = (dot(w, u) * vv - dot(w, v) * uv) / sine2;
    const double t = (dot(w, u) * uv - dot(w, v) * uu) / sine2;
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) return length(a + s * u - c - t * v);
  }
  return std::min({length(nearest_on_edge(a, c, d) - a), length(nearest_on_edge(b, c, d) - b),
                   length(nearest_on_edge(c, a, b) - c), length(nearest_on_edge(d, a, b) - d)});
}

bool is_over(std::span<const Vec3> corner, Vec3 normal, Vec3 point) {
  bool inside = true, outside = true;
  for (std::size_t k = 0; k < corner.size(); ++k) {
    const Vec3 edge = corner[(k + 1) % corner.size()] - corner[k];
    const double side = dot(cross(edge, point - corner[k]), normal);
    inside = inside && side >= 0.0, outside = outside && side <= 0.0;
  }
  return inside || outside;
}

/// Least distance from a convex polygon with a unit normal to an edge.
double distance_to_edge(std::span<const Vec3> corner, Vec3 normal, Vec3 a, Vec3 b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < corner.size(); ++k) {
    least = std::min(least, distance_of_edges(corner[k], corner[(k + 1) % corner.size()], a, b));
  }
  for (const Vec3& end : {a, b}) {
    if (is_over(corner, normal, end)) {
      least = std::min(least, std::abs(dot(end - corner[0], normal)));
    }
  }
  return least;
}

double greatest_height(std::span<const Vec3> corner, Vec3 at, Vec3 normal) {
  double height = 0.0;
  for (const Vec3& c : corner) height = std::max(height, std::abs(dot(c - at, normal)));
  return height;
}

Triangle corners_of(const ElementMesh& mesh, std::size_t element) {
  const auto& [a, b, c] = mesh.elements[element];
  return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

}  // namespace

TargetEdges::TargetEdges(const ElementMesh& mesh, const std::vector<Column>& column)
    : mesh_(mesh), column_(column), outline_(mesh.size(), 7) {
  struct Use {
    std::size_t element;
    unsigned edge;
  };
  std::map<std::array<std::tuple<double, double, double>, 2>, Use> first;
  const auto key = [](Vec3 v) { return std::tuple(v.x, v.y, v.z); };
  for (std::size_t e = 0; e < mesh.size(); ++e) {
    const Triangle t = corners_of(mesh, e);
    centre_.push_back(centre_of(t));
    double longest = 0.0, radius = 0.0;
    for (unsigned k = 0; k < 3; ++k) {
      const Vec3 a = t[k], b = t[(k + 1) % 3];
      longest = std::max(longest, length(b - a));
      radius = std::max(radius, length(a - centre_.back()));
      const auto [use, is_first] = first.try_emplace(std::minmax(key(a), key(b)).first == key(a)
                                                         ? std::array{key(a), key(b)}
                                                         : std::array{key(b), key(a)},
                                                     Use{e, k});
      const std::size_t other = use->second.element;
      const bool goes_on = !is_first && column[2 * e] == column[2 * other] &&
                           column[2 * e + 1] == column[2 * other + 1] &&
                           length(mesh.normal(2 * e) - mesh.normal(2 * other)) < 1e-9;
      if (!goes_on) continue;
      outline_[e] &= static_cast<std::uint8_t>(~(1U << k));
      outline_[other] &= static_cast<std::uint8_t>(~(1U << use->second.edge));
    }
    radius_.push_back(radius);
    width_.push_back(2.0 * mesh.area_m2(e) / longest);
  }
}

std::vector<TargetEdges::Doubt> TargetEdges::doubts(std::span<const Vec3> part, std::uint32_t side,
                                                    double ratio,
                                                    const std::vector<char>& wanted) const {
  constexpr double kSome = 0.2, kStep = 0.003;  // of what may rise at most
  const Vec3 normal = mesh_.normal(side), centre = centre_of(part);
  double size = 0.0;
  for (const Vec3& c : part) size = std::max(size, length(c - centre));
  std::vector<Doubt> doubts;
  for (std::uint32_t e = 0; e < mesh_.size(); ++e) {
    if (e == side / 2 || outline_[e] == 0 ||
        length(centre_[e] - centre) > radius_[e] + size + 2.0 * ratio * size) {
      continue;
    }
    const Triangle corner = corners_of(mesh_, e);
    const std::uint32_t seen =
        2 * e + (dot(centre - corner[0], mesh_.normal(2 * e)) < 0.0 ? 1U : 0U);
    if (!wanted[seen] || column_[seen] == kNoColumn) continue;
    const double rises = greatest_height(corner, part[0], normal);
    const double stands = greatest_height(part, corner[0], mesh_.normal(2 * e));
    for (unsigned k = 0; k < 3; ++k) {
      if ((outline_[e] >> k & 1U) == 0) continue;
      const Vec3 a = corner[k], b = corner[(k + 1) % 3];
      const double distance = distance_to_edge(part, normal, a, b);
      const double strip = distance > 1e-9 * radius_[e] ? distance : width_[e];
      const Vec3 to = nearest_on_edge(centre, a, b) - centre;
      Vec3 across = to - dot(to, normal) * normal;
      if (length(across) < 0.1 * length(to)) across = cross(normal, b - a);
      across = normalized(across);
      const double extent = extent_along(part, across);
      if (!(ratio * extent > strip)) continue;
      const double near = std::max(distance, 1e-300);
      const double at_most = std::min(1.0, mesh_.area_m2(e) / (kPi * near * near)) *
                             std::min(1.0, rises / near) * std::min(1.0, stands / near);
      const double missed =
          std::min(std::max(kStep, strip / extent), extent * extent / (strip * strip));
      doubts.push_back({column_[seen], kSome * at_most * missed, across});
    }
  }
  return doubts;
}

}  // namespace tenku
