#include "scene/constrained_delaunay.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <deque>
#include <utility>

#include "scene/scene.h"

namespace tenku {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = Kernel::Point_2;

struct VertexInfo {
  std::uint32_t number = kNone;  ///< none where edges cross between their ends
};
constexpr int kUnseen = -1;
struct FaceInfo {
  int level = kUnseen;  ///< number of bounds between the face and the outside
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<
    Kernel, CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge_between(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

Point2 point(std::array<double, 2> p) { return {p[0], p[1]}; }

}  // namespace

struct ConstrainedDelaunay::Mesh {
  Delaunay all;
  std::vector<Delaunay::Vertex_handle> vertices;
  std::vector<Edge> bounds;
  bool has_lines = false;

  void number(Delaunay::Vertex_handle vertex) {
    if (vertex->info().number != kNone) return;
    vertex->info().number = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(vertex);
  }

  /// Where there are no lines, every edge that is kept bounds, also in pieces.
  bool bounds_at(Delaunay::Face_handle face, int i) const {
    if (!all.is_constrained({face, i})) return false;
    if (!has_lines) return true;
    const auto edge = edge_between(face->vertex(Delaunay::cw(i))->info().number,
                                   face->vertex(Delaunay::ccw(i))->info().number);
    return std::binary_search(bounds.begin(), bounds.end(), edge);
  }

  void mark_nesting();
};

/// Marks each face with the number of bounds between it and the outside.
void ConstrainedDelaunay::Mesh::mark_nesting() {
  if (has_lines) std::sort(bounds.begin(), bounds.end());
  for (const auto face : all.all_face_handles()) face->info().level = kUnseen;
  std::deque<Delaunay::Face_handle> queue{all.infinite_face()};
  all.infinite_face()->info().level = 0;
  while (!queue.empty()) {
    const Delaunay::Face_handle face = queue.front();
    queue.pop_front();
    for (int i = 0; i < 3; ++i) {
      const Delaunay::Face_handle next = face->neighbor(i);
      if (next->info().level != kUnseen) continue;
      const bool crosses = bounds_at(face, i);
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

ConstrainedDelaunay::ConstrainedDelaunay() : mesh_(std::make_unique<Mesh>()) {}
ConstrainedDelaunay::~ConstrainedDelaunay() = default;

ConstrainedDelaunay::Vertex ConstrainedDelaunay::insert(double x, double y) {
  const auto near =
      mesh_->vertices.empty() ? Delaunay::Face_handle() : mesh_->vertices.back()->face();
  const auto vertex = mesh_->all.insert(Point2(x, y), near);
  mesh_->number(vertex);
  return vertex->info().number;
}

void ConstrainedDelaunay::keep_bound(Vertex a, Vertex b) {
  if (a == b) return;
  mesh_->all.insert_constraint(mesh_->vertices[a], mesh_->vertices[b]);
  mesh_->bounds.push_back(edge_between(a, b));
}

void ConstrainedDelaunay::keep_line(Vertex a, Vertex b) {
  if (a == b) return;
  mesh_->all.insert_constraint(mesh_->vertices[a], mesh_->vertices[b]);
  mesh_->has_lines = true;
}

void ConstrainedDelaunay::number_crossings() {
  for (const auto vertex : mesh_->all.finite_vertex_handles()) mesh_->number(vertex);
}

std::size_t ConstrainedDelaunay::size() const { return mesh_->all.number_of_vertices(); }

std::array<double, 2> ConstrainedDelaunay::place(Vertex v) const {
  const Point2& p = mesh_->vertices[v]->point();
  return {p.x(), p.y()};
}

std::vector<ConstrainedDelaunay::Face> ConstrainedDelaunay::inside() {
  std::vector<Face> faces;
  if (mesh_->all.dimension() < 2) return faces;
  mesh_->mark_nesting();
  faces.reserve(mesh_->all.number_of_faces());
  for (const auto face : mesh_->all.finite_face_handles()) {
    if (face->info().level % 2 == 0) continue;
    Face& made = faces.emplace_back();
    for (int i = 0; i < 3; ++i) {
      made.corner[static_cast<std::size_t>(i)] = face->vertex(i)->info().number;
      made.is_kept[static_cast<std::size_t>(i)] = mesh_->all.is_constrained({face, i});
    }
  }
  return faces;
}

bool segments_cross(std::array<double, 2> a, std::array<double, 2> b, std::array<double, 2> c,
                    std::array<double, 2> d) {
  const auto is_end = [](const auto& p, const auto& q, const auto& r) { return p == q || p == r; };
  const int shared = static_cast<int>(is_end(a, c, d)) + static_cast<int>(is_end(b, c, d));
  if (shared == 2) return false;
  const Kernel::Segment_2 first(point(a), point(b)), second(point(c), point(d));
  if (shared == 0) return CGAL::do_intersect(first, second);
  // With one end in common they meet elsewhere only if one of the other ends lies on the other.
  const auto& far = is_end(a, c, d) ? b : a;
  const auto& other = is_end(c, a, b) ? d : c;
  return second.has_on(point(far)) || first.has_on(point(other));
}

}  // namespace tenku
