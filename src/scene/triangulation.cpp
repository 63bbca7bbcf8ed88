#include "scene/triangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <span>
#include <utility>

namespace tenku {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = Kernel::Point_2;

struct VertexInfo {
  std::uint32_t index = kNone;  ///< none where boundaries cross between their vertices
};
constexpr int kUnseen = -1;

struct FaceInfo {
  int level = kUnseen;  ///< number of boundaries between the face and the outside
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<
    Kernel, CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;

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

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Edges of all rings. One that is passed twice, as where a hole is tied to the outer ring, bounds
/// nothing and is left out.
class Boundary {
 public:
  void add(const std::vector<Delaunay::Vertex_handle>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto a = ring[i], b = ring[(i + 1) % ring.size()];
      if (a == b) continue;
      const std::uint32_t from = a->info().index, to = b->info().index;
      Pass& pass = passes_[{std::min(from, to), std::max(from, to)}];
      pass = {a, b, !pass.is_odd};
    }
  }
  void constrain(Delaunay& mesh) const {
    for (const auto& [edge, pass] : passes_) {
      if (pass.is_odd) mesh.insert_constraint(pass.a, pass.b);
    }
  }

 private:
  struct Pass {
    Delaunay::Vertex_handle a, b;
    bool is_odd = false;
  };
  std::map<Edge, Pass> passes_;
};

/// Marks each face with the number of boundaries between it and the outside.
void mark_nesting(Delaunay& mesh) {
  for (auto face : mesh.all_face_handles()) face->info().level = kUnseen;
  std::deque<Delaunay::Face_handle> queue{mesh.infinite_face()};
  mesh.infinite_face()->info().level = 0;
  while (!queue.empty()) {
    const Delaunay::Face_handle face = queue.front();
    queue.pop_front();
    for (int i = 0; i < 3; ++i) {
      const Delaunay::Face_handle next = face->neighbor(i);
      if (next->info().level != kUnseen) continue;
      const bool crosses = mesh.is_constrained({face, i});
      next->info().level = face->info().level + (crosses ? 1 : 0);
      // Faces of the same level first, so that each level is complete before the next begins.
      if (crosses) {
        queue.push_back(next);
      } else {
        queue.push_front(next);
      }
    }
  }
}

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

Delaunay mesh_of(const Surfaces& surfaces, std::size_t surface, const Plane& plane,
                 std::vector<Vec3>& vertices) {
  Delaunay mesh;
  Boundary boundary;
  std::vector<Delaunay::Vertex_handle> handles;
  for (std::size_t r = surfaces.first_ring[surface]; r < surfaces.first_ring[surface + 1]; ++r) {
    handles.clear();
    for (const std::uint32_t v : surfaces.ring(r)) {
      const std::size_t before = mesh.number_of_vertices();
      const auto handle = mesh.insert(plane.flat(vertices[v]));
      if (mesh.number_of_vertices() > before) handle->info().index = v;
      handles.push_back(handle);
    }
    boundary.add(handles);
  }
  boundary.constrain(mesh);
  for (auto vertex : mesh.finite_vertex_handles()) {
    if (vertex->info().index != kNone) continue;
    vertex->info().index = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(plane.lifted(vertex->point()));
  }
  return mesh;
}

}  // namespace

PolygonShape shape_of(const Scene& scene, std::size_t surface) {
  const Plane plane = plane_of(scene.surfaces, surface, scene.vertices);
  PolygonShape shape;
  for (std::size_t r = scene.surfaces.first_ring[surface];
       r < scene.surfaces.first_ring[surface + 1]; ++r) {
    const auto ring = scene.surfaces.ring(r);
    for (const std::uint32_t v : ring) {
      const double off = std::abs(dot(scene.vertices[v] - plane.origin, plane.normal));
      shape.off_plane_m = std::max(shape.off_plane_m, off);
    }
    const std::vector<Point2> flat = flat_ring(ring, plane, scene.vertices);
    if (flat.size() == 4 && is_convex(flat)) continue;
    shape.is_simple = shape.is_simple && CGAL::is_simple_2(flat.begin(), flat.end(), Kernel());
  }
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
  Delaunay mesh = mesh_of(surfaces, surface, plane, vertices);
  if (mesh.dimension() < 2) return;  // goes to and fro on a line: nothing to fill
  mark_nesting(mesh);
  for (auto face : mesh.finite_face_handles()) {
    if (face->info().level % 2 == 0) continue;
    std::array<std::uint32_t, 3> triangle{};
    for (int i = 0; i < 3; ++i) {
      triangle[static_cast<std::size_t>(i)] = face->vertex(i)->info().index;
    }
    triangles.push_back(triangle);
  }
}

}  // namespace tenku
