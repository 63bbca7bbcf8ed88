/// Coplanar triangles joined into polygons: what is to be divided, free of how a file divided it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vec3.h"
#include "meshing/surface_flaw.h"
#include "scene/material.h"
#include "scene/triangle_soup.h"

namespace tenku {

/// Point of a polygon's plane, metres along its axes.
struct PlanePoint {
  double x = 0.0, y = 0.0;
};

/// A connected flat surface of one material and object, with holes or without.
///
/// Frame    the front, from which `normal` rises, has the surface to the left of every ring:
///          outer rings run counter-clockwise, holes clockwise. `along` follows the longest edge.
/// Units    metres.
struct FlatPolygon {
  std::vector<std::vector<Vec3>> rings;  ///< corners, in no order of the rings
  Vec3 origin, along, across, normal;    ///< right-handed, unit
  std::uint32_t material = 0, object = 0;
  std::vector<std::uint32_t> triangles;  ///< joined here, by index into the soup
  int layers = 1;                        ///< so many times the triangles fill the rings
  double area_m2 = 0.0;                  ///< sum of those of the triangles, by `layers`

  PlanePoint flat(Vec3 p) const { return {dot(p - origin, along), dot(p - origin, across)}; }
  Vec3 lifted(PlanePoint p) const { return origin + p.x * along + p.y * across; }
};

/// How far apart things may be that are taken for one.
struct JoinTolerance {
  double weld_m = 1e-6;   ///< of vertices, and of a vertex and the edge that it lies on
  double plane_m = 1e-5;  ///< of a vertex from the plane

  /// A millionth of the scene's extent, or the steps of 32-bit floats at its largest coordinate if
  /// these are longer; ten times as much off a plane.
  static JoinTolerance of(std::span<const Vec3> vertices);
};

/// Polygons, and what they could not be made of.
struct JoinedSurfaces {
  std::vector<FlatPolygon> polygons;  ///< in the order of their first triangles
  std::vector<SurfaceFlaw> flaws;     ///< triangles without area, and those that are there twice
  std::vector<std::uint32_t> weld;    ///< [vertex of the soup] the one that stands for it
};

/// Joins the triangles that are not glass: neighbours across an edge, or a part of one, that have
/// the same material and object and lie in one plane, whichever way they are turned. The front is
/// that of the greater part of the area. Vertices between which an edge runs straight are left out.
///
/// Triangles without area give nothing. Where two have the same corners the later one is left out,
/// also where it is another object's. Where triangles overlap otherwise, the rings do not enclose
/// `area_m2`.
///
/// Cost     1 us per triangle.
JoinedSurfaces join_coplanar(const TriangleSoup& soup, std::span<const Material> materials,
                             const JoinTolerance& tolerance);

/// Triangle `t` of a soup as a polygon of its own.
/// @param weld  as in `JoinedSurfaces`
FlatPolygon triangle_polygon(const TriangleSoup& soup, std::span<const std::uint32_t> weld,
                             std::uint32_t t);

}  // namespace tenku
