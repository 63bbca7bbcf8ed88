/// Polygons made by hand, and what must be true of their meshes.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "meshing/flat_polygon.h"
#include "meshing/polygon_mesh.h"

namespace tenku::testing_support {

using Ring = std::vector<PlanePoint>;

/// Area to the left of a ring, by the shoelace formula.
inline double signed_area(const Ring& ring) {
  double doubled = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const PlanePoint p = ring[i], q = ring[(i + 1) % ring.size()];
    doubled += p.x * q.y - p.y * q.x;
  }
  return 0.5 * doubled;
}

/// @param frame  its axes and its origin; rings are in its plane
inline FlatPolygon polygon_of(const std::vector<Ring>& rings, FlatPolygon frame) {
  frame.rings.clear();
  frame.area_m2 = 0.0;
  for (const Ring& ring : rings) {
    auto& corners = frame.rings.emplace_back();
    for (const PlanePoint p : ring) corners.push_back(frame.lifted(p));
    frame.area_m2 += signed_area(ring);
  }
  return frame;
}

inline FlatPolygon level_frame() {
  FlatPolygon frame;
  frame.along = {1, 0, 0};
  frame.across = {0, 1, 0};
  frame.normal = {0, 0, 1};
  return frame;
}

inline FlatPolygon polygon_of(const std::vector<Ring>& rings) {
  return polygon_of(rings, level_frame());
}

inline FlatPolygon rectangle(double width, double height) {
  return polygon_of({{{0, 0}, {width, 0}, {width, height}, {0, height}}});
}

inline double around(const FlatPolygon& polygon) {
  double sum = 0.0;
  for (const auto& ring : polygon.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      sum += length(ring[(i + 1) % ring.size()] - ring[i]);
    }
  }
  return sum;
}

/// What a mesh of one polygon covers, and how its elements meet.
struct Cover {
  double area_m2 = 0.0, border_m = 0.0;
  double least_height_m = 1e300;  ///< of an element, over its longest edge; negative if turned
  long euler = 0;                 ///< pieces less holes
  bool is_manifold = true;        ///< every edge has one element to a side
};

inline Cover cover_of(const FlatPolygon& polygon, const PolygonMesh& mesh) {
  Cover made;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;  // directed
  std::vector<std::uint8_t> is_used(mesh.vertices.size());
  for (const auto& t : mesh.elements) {
    const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    const double doubled = dot(cross(b - a, c - a), polygon.normal);
    made.area_m2 += 0.5 * doubled;
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    made.least_height_m = std::min(made.least_height_m, doubled / longest);
    for (unsigned k = 0; k < 3; ++k) {
      is_used[t[k]] = 1;
      if (++uses[{t[k], t[(k + 1) % 3]}] > 1) made.is_manifold = false;
    }
  }
  long borders = 0;
  for (const auto& [edge, n] : uses) {
    if (uses.count({edge.second, edge.first}) != 0) continue;
    ++borders;
    made.border_m += length(mesh.vertices[edge.first] - mesh.vertices[edge.second]);
  }
  const long edges = (static_cast<long>(uses.size()) + borders) / 2;
  made.euler = std::count(is_used.begin(), is_used.end(), 1) - edges +
               static_cast<long>(mesh.elements.size());
  return made;
}

/// The mesh fills the polygon: its area, without an element turned over, and no border but the
/// polygon's, which a vertex on the edge of another element would add to.
inline void expect_fills(const FlatPolygon& polygon, const PolygonMesh& mesh, double weld_m) {
  const Cover cover = cover_of(polygon, mesh);
  const double edge_m = around(polygon);
  EXPECT_NEAR(cover.area_m2, polygon.area_m2, weld_m * edge_m + 1e-9 * polygon.area_m2);
  EXPECT_NEAR(cover.border_m, edge_m, 1e-6 * edge_m + 20.0 * weld_m);
  EXPECT_GT(cover.least_height_m, 0.0);
  EXPECT_TRUE(cover.is_manifold);
}

}  // namespace tenku::testing_support
