/// The opaque triangles of a scene in an order in which neighbours in space are neighbours.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/extent.h"
#include "scene/material.h"
#include "scene/triangle_soup.h"
#include "visibility/caster_map.h"
#include "visibility/mesh_adjacency.h"

namespace tenku {

/// Plane of a triangle: the points x with dot(normal, x) = offset.
struct CasterPlane {
  Vec3 normal;    ///< unit
  double offset;  ///< metres
};

/// Axes across the light: unit vectors at right angles, u level, v upward, w toward the light.
struct LightAxes {
  Vec3 u, v, w;

  explicit LightAxes(Vec3 direction);
};

/// Where points lie across the light: a grid of cells over their rectangle, with the numbers of
/// points summed over all cells below and to the left, so that a rectangle is asked in one step.
class LightCells {
 public:
  /// @param low_u, low_v, high_u, high_v  rectangle along the axes of the light, metres
  LightCells(double low_u, double low_v, double high_u, double high_v);

  void add(double u, double v);
  void sum_up();
  /// Whether points may lie in a rectangle.
  bool has_points(double low_u, double low_v, double high_u, double high_v) const;

 private:
  static constexpr int kSide = 128;
  static int cell(double at) { return static_cast<int>(std::min(std::max(at, 0.0), kSide - 1.0)); }
  double low_u_, low_v_, per_u_, per_v_;  ///< cells per metre
  std::vector<std::uint32_t> count_;      ///< [row + 1][column + 1], the first of each zero
};

/// A part of space seen along a direction: coordinates along u, v and w as x, y and z.
struct LightBox {
  LightAxes axes;
  Vec3 low, high;
  const LightCells* cells = nullptr;  ///< of the points in it, borrowed; null: anywhere
};

/// How a triangle lies to a point, seen along a direction.
enum class Cover {
  Hides,    ///< the light meets it, or one joined to it, on the way to the point
  Beside,   ///< its outline, or that of what is joined to it, runs between the two
  Unknown,  ///< too many triangles lie between the two
};

/// Casters of shadows, in chunks with boxes about them. Triangles without an area cast none, nor
/// does glass.
///
/// Threads  immutable after construction; may be shared.
class CasterSet {
 public:
  /// @param soup  kept by reference: it must outlive this object
  CasterSet(const TriangleSoup& soup, const std::vector<Material>& materials);

  /// Plane of a triangle of the soup that is a caster.
  const CasterPlane& plane(std::uint32_t triangle) const { return plane_[triangle]; }

  /// The casters about a local origin, numbered by their triangle in the soup, from 1.
  /// Shape  [caster][3].
  std::vector<CasterVertex> vertices(Vec3 origin) const;

  /// The casters whose chunk overlaps the box sideways and reaches its far end at least. A chunk
  /// nearer to the light than the box counts, but not one outside of `reach`.
  struct Selection {
    std::vector<CasterRange> casters;
    double nearest = 0.0;  ///< greatest coordinate along w of any of them
  };
  Selection before(const LightBox& box, const Extent& reach) const;

  /// Goes over the mesh from a triangle to the one that the line from `point` to the light meets.
  /// @param tolerance_m  as in `is_behind`
  Cover cover(std::uint32_t triangle, Vec3 point, const LightAxes& axes, double tolerance_m) const;

  /// Whether the plane of a triangle lies between a point and the light, by more than the
  /// tolerance.
  bool is_behind(std::uint32_t triangle, Vec3 point, Vec3 toward_light, double tolerance_m) const {
    const CasterPlane& plane = plane_[triangle];
    const double before = dot(plane.normal, point) - plane.offset;
    return (dot(plane.normal, toward_light) < 0.0 ? -before : before) < -tolerance_m;
  }

 private:
  struct Chunk {
    CasterRange range;
    Vec3 centre, half;
  };
  static bool shades_points(const Chunk& chunk, const LightBox& box);
  bool is_caster(std::uint32_t triangle) const { return plane_[triangle].normal != Vec3{}; }
  Vec3 corner(std::uint32_t triangle, unsigned k) const {
    return soup_.vertices[soup_.triangles[triangle][k]];
  }

  const TriangleSoup& soup_;
  MeshAdjacency adjacency_;
  std::vector<CasterPlane> plane_;    ///< [triangle], zero where it is no caster
  std::vector<std::uint32_t> order_;  ///< triangles, neighbours in space near each other
  std::vector<Chunk> chunk_;
};

}  // namespace tenku
