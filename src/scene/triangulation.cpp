#include "scene/triangulation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "scene/constrained_delaunay.h"

namespace tenku {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = Kernel::Point_2;

/// Mean plane of a polygon with a right-handed frame in it.
struct Plane {
  Vec3 origin, normal, tangent, bitangent;

  Point2 flat(Vec3 p) const { return {dot(p - origin, tangent), dot(p - origin, bitangent)}; }
  Vec3 lifted(const Point2& p) const { return origin + p.x() * tangent + p.y() * bitangent; }
};

/// Twice the area vector of the outer ring; of its widest corner if the whole adds up to nothing,
/// as in a figure of eight.
Vec3 normal_of(std::span<const std::uint32_t> ring, const std::vector<Vec3>& vertices) {
  const Vec3 origin = vertices[ring[0]];
  Vec3 sum{}, widest{};
  double around = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 a = vertices[ring[i]] - origin, b = vertices[ring[(i + 1) % ring.size()]] - origin;
    const Vec3 corner = cross(a, b);
    sum = sum + corner;
    around += dot(b - a, b - a);
    if (dot(corner, corner) > dot(widest, widest)) widest = corner;
  }
  constexpr double kNothing = 1e-9;
  return length(sum) > kNothing * around ? sum : widest;
}

Plane plane_of(const Surfaces& surfaces, std::size_t surface, const std::vector<Vec3>& vertices) {
  const auto ring = surfaces.outer_ring(surface);
  Plane plane;
  plane.normal = normalized(normal_of(ring, vertices));
  if (!is_finite(plane.normal)) plane.normal = kZenith;
  for (const std::uint32_t v : ring) plane.origin = plane.origin + vertices[v];
  plane.origin = (1.0 / static_cast<double>(ring.size())) * plane.origin;
  const TangentFrame frame = tangent_frame(plane.normal);
  plane.tangent = frame.tangent;
  plane.bitangent = frame.bitangent;
  return plane;
}

/// Edges of all rings. One that is passed twice, as where a hole is tied to the outer ring, bounds
/// nothing and is left out.
class Boundary {
 public:
  using Vertex = ConstrainedDelaunay::Vertex;

  void add(const std::vector<Vertex>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vertex a = ring[i], b = ring[(i + 1) % ring.size()];
      if (a == b) continue;
      Pass& pass = passes_[{std::min(a, b), std::max(a, b)}];
      pass = {a, b, !pass.is_odd};
    }
  }
  void keep_in(ConstrainedDelaunay& mesh) const {
    for (const auto& [edge, pass] : passes_) {
      if (pass.is_odd) mesh.keep_bound(pass.a, pass.b);
    }
  }

 private:
  struct Pass {
    Vertex a, b;
    bool is_odd = false;
  };
  std::map<std::pair<Vertex, Vertex>, Pass> passes_;
};

bool is_convex(const std::vector<Point2>& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point2 &a = ring[i], &b = ring[(i + 1) % ring.size()], &c = ring[(i + 2) % ring.size()];
    if (!CGAL::left_turn(a, b, c)) return false;
  }
  return true;
}

std::vector<Point2> flat_ring(std::span<const std::uint32_t> ring, const Plane& plane,
                              const std::vector<Vec3>& vertices) {
  std::vector<Point2> flat;
  flat.reserve(ring.size());
  for (const std::uint32_t v : ring) flat.push_back(plane.flat(vertices[v]));
  return flat;
}

/// Splits a convex quadrilateral along its shorter diagonal.
void split_quad(std::span<const std::uint32_t> q, const std::vector<Vec3>& vertices,
                std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const Vec3 d02 = vertices[q[2]] - vertices[q[0]], d13 = vertices[q[3]] - vertices[q[1]];
  if (dot(d02, d02) <= dot(d13, d13)) {
    triangles.push_back({q[0], q[1], q[2]});
    triangles.push_back({q[0], q[2], q[3]});
  } else {
    triangles.push_back({q[0], q[1], q[3]});
    triangles.push_back({q[1], q[2], q[3]});
  }
}

/// Rings of a surface in a triangulation.
/// @return  the scene's vertex for each of the triangulation's
std::vector<std::uint32_t> fill(ConstrainedDelaunay& mesh, const Surfaces& surfaces,
                                std::size_t surface, const Plane& plane,
                                std::vector<Vec3>& vertices) {
  Boundary boundary;
  std::vector<std::uint32_t> of_scene;
  for (std::size_t r = surfaces.first_ring[surface]; r < surfaces.first_ring[surface + 1]; ++r) {
    std::vector<ConstrainedDelaunay::Vertex> ring;
    for (const std::uint32_t v : surfaces.ring(r)) {
      const Point2 p = plane.flat(vertices[v]);
      ring.push_back(mesh.insert(p.x(), p.y()));
      if (ring.back() == of_scene.size()) of_scene.push_back(v);
    }
    boundary.add(ring);
  }
  boundary.keep_in(mesh);
  mesh.number_crossings();
  while (of_scene.size() < mesh.size()) {
    const auto [x, y] = mesh.place(static_cast<ConstrainedDelaunay::Vertex>(of_scene.size()));
    of_scene.push_back(static_cast<std::uint32_t>(vertices.size()));
    vertices.push_back(plane.lifted({x, y}));
  }
  return of_scene;
}

using Ring2 = std::vector<Point2>;

/// On the given side of a ring and farther from it than rounding explains.
bool is_clearly(CGAL::Bounded_side side, const Point2& p, const Ring2& ring) {
  constexpr double kClear_m = 0.01;
  if (CGAL::bounded_side_2(ring.begin(), ring.end(), p, Kernel()) != side) return false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Kernel::Segment_2 edge(ring[k], ring[(k + 1) % ring.size()]);
    if (CGAL::squared_distance(p, edge) < kClear_m * kClear_m) return false;
  }
  return true;
}

bool has_stray_hole(const std::vector<Ring2>& rings) {
  for (std::size_t r = 1; r < rings.size(); ++r) {
    for (const Point2& p : rings[r]) {
      if (is_clearly(CGAL::ON_UNBOUNDED_SIDE, p, rings[0])) return true;
      for (std::size_t o = 1; o < rings.size(); ++o) {
        if (o != r && is_clearly(CGAL::ON_BOUNDED_SIDE, p, rings[o])) return true;
      }
    }
  }
  return false;
}

}  // namespace

PolygonShape shape_of(const Scene& scene, std::size_t surface) {
  const Plane plane = plane_of(scene.surfaces, surface, scene.vertices);
  PolygonShape shape;
  std::vector<Ring2> rings;
  for (std::size_t r = scene.surfaces.first_ring[surface];
       r < scene.surfaces.first_ring[surface + 1]; ++r) {
    const auto ring = scene.surfaces.ring(r);
    for (const std::uint32_t v : ring) {
      const double off = std::abs(dot(scene.vertices[v] - plane.origin, plane.normal));
      shape.off_plane_m = std::max(shape.off_plane_m, off);
    }
    rings.push_back(flat_ring(ring, plane, scene.vertices));
    const Ring2& flat = rings.back();
    if (flat.size() == 4 && is_convex(flat)) continue;
    shape.is_simple = shape.is_simple && CGAL::is_simple_2(flat.begin(), flat.end(), Kernel());
  }
  shape.has_stray_hole = shape.is_simple && has_stray_hole(rings);
  return shape;
}

void triangulate_polygon(const Surfaces& surfaces, std::size_t surface, std::vector<Vec3>& vertices,
                         std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const auto outer = surfaces.outer_ring(surface);
  const bool is_plain = surfaces.rings(surface) == 1;
  if (is_plain && outer.size() == 3) {
    triangles.push_back({outer[0], outer[1], outer[2]});
    return;
  }
  const Plane plane = plane_of(surfaces, surface, vertices);
  if (is_plain && outer.size() == 4 && is_convex(flat_ring(outer, plane, vertices))) {
    return split_quad(outer, vertices, triangles);
  }
  ConstrainedDelaunay mesh;
  const std::vector<std::uint32_t> of_scene = fill(mesh, surfaces, surface, plane, vertices);
  for (const auto& [corner, is_kept] : mesh.inside()) {
    triangles.push_back({of_scene[corner[0]], of_scene[corner[1]], of_scene[corner[2]]});
  }
}

}  // namespace tenku
