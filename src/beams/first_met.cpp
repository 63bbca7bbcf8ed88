#include "beams/first_met.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tenku {
namespace {

constexpr double kSameSurface = 1e-3;  // m
constexpr double kSameDepth = 1e-6;    // m: of two surfaces in one place the first is kept

struct Candidate {
  std::uint32_t triangle;
  SunOutline outline;
  DepthPlane plane;
  double nearest;
};

struct Piece {
  SunOutline outline;
  const Candidate* met = nullptr;
};

/// The beam as half-spaces: its sides and its beginning.
std::vector<HalfSpace> space_of(const BeamStart& start) {
  std::vector<HalfSpace> spaces;
  const BeamFrame& f = start.frame;
  for (std::size_t k = 0; k < start.outline.size(); ++k) {
    const HalfPlane side = HalfPlane::left_of(
        start.outline[k], start.outline[k + 1 < start.outline.size() ? k + 1 : 0]);
    spaces.push_back({side.a * f.x_axis + side.b * f.y_axis, side.c});
  }
  const DepthPlane& p = start.plane;
  spaces.push_back({f.along - p.slope_x * f.x_axis - p.slope_y * f.y_axis, -p.at_origin});
  return spaces;
}

std::vector<Candidate> candidates_in(const BeamStart& start, const TriangleTree& tree) {
  std::vector<std::uint32_t> found;
  tree.find(space_of(start), found);
  std::vector<Candidate> result;
  const TriangleSoup& soup = tree.soup();
  for (const std::uint32_t t : found) {
    const Vec3 normal = normal_of(soup, t);
    if (!(std::abs(dot(normal, start.frame.along)) > kEdgeOn)) continue;  // also of no area
    const auto& [a, b, c] = soup.triangles[t];
    const std::vector<Vec3> corners{soup.vertices[a], soup.vertices[b], soup.vertices[c]};
    const DepthPlane plane(start.frame, corners[0], normal);
    SunOutline inside = cut_by(outline_of(start.frame, corners), start.outline).inside;
    if (inside.empty()) continue;
    inside = split(inside, HalfPlane::before(start.plane, plane)).first;
    const double height = start.cosine * greatest(inside, [&](AcrossPoint p) {
                            return plane.depth(p) - start.plane.depth(p);
                          });
    if (inside.empty() || !(height > kSameSurface)) continue;
    const double nearest = -greatest(inside, [&](AcrossPoint p) { return -plane.depth(p); });
    result.push_back({t, std::move(inside), plane, nearest});
  }
  std::sort(result.begin(), result.end(), [](const Candidate& a, const Candidate& b) {
    return a.nearest < b.nearest || (a.nearest == b.nearest && a.triangle < b.triangle);
  });
  return result;
}

/// Puts into `pieces` what becomes of `piece` when `next` is there too.
void meet(Piece&& piece, const Candidate& next, std::vector<Piece>& pieces) {
  const Candidate* met = piece.met;
  if (met != nullptr &&
      greatest(piece.outline, [&](AcrossPoint p) { return met->plane.depth(p); }) <= next.nearest) {
    pieces.push_back(std::move(piece));
    return;
  }
  CutOutline cut = cut_by(piece.outline, next.outline);
  if (cut.inside.empty()) {
    pieces.push_back(std::move(piece));
    return;
  }
  SunOutline nearer = cut.inside, further;
  if (met != nullptr) {
    const HalfPlane before = HalfPlane::before(next.plane, met->plane);
    if (greatest(cut.inside, [&](AcrossPoint p) { return before.height(p); }) <= kSameDepth) {
      pieces.push_back(std::move(piece));
      return;
    }
    std::tie(nearer, further) = split(cut.inside, before);
  }
  for (SunOutline& rest : cut.outside) pieces.push_back({std::move(rest), met});
  if (!further.empty()) pieces.push_back({std::move(further), met});
  if (!nearer.empty()) pieces.push_back({std::move(nearer), &next});
}

}  // namespace

Vec3 normal_of(const TriangleSoup& soup, std::uint32_t triangle) {
  const auto& [a, b, c] = soup.triangles[triangle];
  return normalized(
      cross(soup.vertices[b] - soup.vertices[a], soup.vertices[c] - soup.vertices[a]));
}

std::vector<MetPiece> first_met(const BeamStart& start, const TriangleTree& tree) {
  const std::vector<Candidate> candidates = candidates_in(start, tree);
  std::vector<Piece> pieces{{start.outline, nullptr}}, next;
  for (const Candidate& candidate : candidates) {
    next.clear();
    for (Piece& piece : pieces) meet(std::move(piece), candidate, next);
    pieces.swap(next);
  }
  std::vector<MetPiece> result;
  result.reserve(pieces.size());
  for (Piece& piece : pieces) {
    result.push_back({std::move(piece.outline),
                      piece.met != nullptr ? piece.met->triangle : MetPiece::kNothing});
  }
  return result;
}

}  // namespace tenku
