#include "visibility/sky_boundary.h"

#include <algorithm>
#include <cmath>

namespace tenku {
namespace {

constexpr double kTouching = 1e-6;  // of an edge's length
constexpr double kShortest = 1e-6;  // radians

/// An outline before it is cut: an arc, and the places along it where others cross.
struct Arc {
  Vec3 a, b;
  Vec3 outward;
  std::vector<double> cut{0.0, 1.0};

  Vec3 at(double t) const { return a + t * (b - a); }
};

/// Cuts away what lies below the plane through the origin; false if nothing is left.
bool clip(Arc& arc, Vec3 up) {
  const double a = dot(arc.a, up), b = dot(arc.b, up);
  if (!(a > 0.0) && !(b > 0.0)) return false;
  const Vec3 from = arc.a, along = arc.b - arc.a;
  if (a < 0.0) arc.a = from + (a / (a - b)) * along;
  if (b < 0.0) arc.b = from + (a / (a - b)) * along;
  return true;
}

/// Where the line of `arc` crosses `other`, as a place along `arc`.
std::optional<double> crossing(const Arc& arc, const Arc& other) {
  const auto place = [](const Arc& line, const Arc& plane) -> std::optional<double> {
    const Vec3 normal = cross(plane.a, plane.b);
    const double a = dot(normal, line.a), b = dot(normal, line.b);
    if (a == b) return std::nullopt;
    return a / (a - b);
  };
  const auto t = place(arc, other), u = place(other, arc);
  if (!t || !u || *t < kTouching || *t > 1.0 - kTouching) return std::nullopt;
  if (*u < -kTouching || *u > 1.0 + kTouching) return std::nullopt;
  if (!(dot(arc.at(*t), other.at(*u)) > 0.0)) return std::nullopt;
  return t;
}

/// The edge as the origin sees it, if both of its faces lie on one side of it.
std::optional<Arc> outline(const SharpEdge& edge, Vec3 origin) {
  const Vec3 a = edge.a - origin, b = edge.b - origin;
  const Vec3 across = cross(a, b);
  const double length = std::sqrt(dot(across, across));
  if (!(length > 0.0)) return std::nullopt;
  const double side = dot(across, edge.face - origin);
  if (edge.other && side * dot(across, *edge.other - origin) < 0.0) return std::nullopt;
  return Arc{a, b, (side > 0.0 ? -1.0 / length : 1.0 / length) * across};
}

}  // namespace

std::optional<std::vector<BoundaryPiece>> sky_boundary(const RayVisibility& rays, Vec3 origin,
                                                       Vec3 normal, std::uint64_t& rays_sent) {
  if (rays.few_edges().empty()) return std::nullopt;
  std::vector<Arc> arcs;
  for (const SharpEdge& edge : rays.few_edges()) {
    std::optional<Arc> arc = outline(edge, origin);
    if (!arc || !clip(*arc, kZenith) || !clip(*arc, normal)) continue;
    if (arcs.size() == kMostOutlines) return std::nullopt;
    arcs.push_back(std::move(*arc));
  }
  std::vector<BoundaryPiece> result;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    Arc& arc = arcs[i];
    for (std::size_t k = 0; k < arcs.size(); ++k) {
      if (k == i) continue;
      if (const auto place = crossing(arc, arcs[k])) arc.cut.push_back(*place);
    }
    std::sort(arc.cut.begin(), arc.cut.end());
    for (std::size_t k = 0; k + 1 < arc.cut.size(); ++k) {
      const BoundaryPiece piece{arc.at(arc.cut[k]), arc.at(arc.cut[k + 1]), arc.outward};
      const Vec3 a = normalized(piece.a), b = normalized(piece.b);
      if (dot(b - a, b - a) < kShortest * kShortest) continue;
      const Vec3 beside = normalized(normalized(a + b) + kBeside * arc.outward);
      if (!(beside.z > 0.0) || !(dot(beside, normal) > 0.0)) continue;
      ++rays_sent;
      if (!rays.is_occluded(origin, beside)) result.push_back(piece);
    }
  }
  return result;
}

}  // namespace tenku
