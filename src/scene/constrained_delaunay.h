/// Triangulations of the plane that keep given edges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace tenku {

/// A Delaunay triangulation that grows by points and by edges that it must keep (CGAL, exact
/// predicates).
///
/// Vertices have numbers in the order in which they come. Where edges cross, the crossing becomes a
/// vertex, which has a number after the next `number_crossings`.
class ConstrainedDelaunay {
 public:
  using Vertex = std::uint32_t;

  /// A triangle, counter-clockwise.
  struct Face {
    std::array<Vertex, 3> corner;
    std::array<bool, 3> is_kept;  ///< the edge opposite to the corner
  };

  ConstrainedDelaunay();
  ~ConstrainedDelaunay();
  ConstrainedDelaunay(const ConstrainedDelaunay&) = delete;
  ConstrainedDelaunay& operator=(const ConstrainedDelaunay&) = delete;

  /// @return  the number of the vertex at this place: an earlier one's, if there is one. Fast where
  ///          the vertex before is near.
  Vertex insert(double x, double y);

  /// Keeps the edge between two vertices, which bounds the surface.
  void keep_bound(Vertex a, Vertex b);
  /// Keeps an edge that has surface on both sides. Then no bound may be crossed by another edge.
  void keep_line(Vertex a, Vertex b);

  /// Numbers the vertices where kept edges crossed.
  void number_crossings();

  std::size_t size() const;  ///< vertices, also those without numbers
  std::array<double, 2> place(Vertex v) const;

  /// The faces between an odd number of bounds and the outside; none where all is on a line.
  std::vector<Face> inside();

 private:
  struct Mesh;
  std::unique_ptr<Mesh> mesh_;
};

/// Whether two segments have a point in common that is not an end of both; decided exactly.
bool segments_cross(std::array<double, 2> a, std::array<double, 2> b, std::array<double, 2> c,
                    std::array<double, 2> d);

}  // namespace tenku
