/// The whole boundary of the sky that one point sees, in scenes of few edges.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/vec3.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// A part of a sharp edge with the sky on one side and a surface on the other, relative to the
/// point that sees it.
struct BoundaryPiece {
  Vec3 a, b;
  Vec3 outward;  ///< unit vector across the edge, toward the sky
};

/// The parts of sharp edges that bound the sky above the horizon in front of a surface, where the
/// scene has few of them (`RayVisibility::few_edges`).
///
/// Edges that are outlines for the point (their faces lie on one side) are cut where they cross
/// each other; of such a part all or nothing bounds the sky, and a ray beside its middle tells.
///
/// Error    what lies within kBeside of an edge is taken for the edge.
/// @param normal  of the surface, unit vector
/// @return none where edges are many, more than kMostOutlines of them outlines
std::optional<std::vector<BoundaryPiece>> sky_boundary(const RayVisibility& rays, Vec3 origin,
                                                       Vec3 normal, std::uint64_t& rays_sent);

inline constexpr std::size_t kMostOutlines = 64;
inline constexpr double kBeside = 1e-4;  ///< radians

}  // namespace tenku
