/// Triangles whose corners are the centres of bubbles that fill a polygon.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "meshing/flat_polygon.h"
#include "meshing/polygon_mesh.h"

namespace tenku {

/// A line that edges of a mesh follow, as the edge of a shadow.
struct ConstraintSegment {
  PlanePoint a, b;
};

/// Size of elements at a place of a polygon, metres; asked for by any thread.
using SizeAt = std::function<double(std::size_t polygon, PlanePoint at)>;

/// When bubbles have moved enough, and what is not moved.
struct BubbleOptions {
  std::size_t steps_most = 60;          ///< of the motion of a polygon's bubbles
  double motion = 0.003;                ///< root mean square of a step, in sizes, that ends it
  std::size_t vertices_most = 200'000;  ///< of a polygon; more are refused
  /// [polygon] meshes that stay as they are, where they have elements; none, or as many as there
  /// are polygons. What is meshed beside one takes over its vertices on the edge that they share.
  std::span<const PolygonMesh> kept;
};

/// How good a mesh is, after all that is done to it.
struct MeshQuality {
  double mean_smallest_angle_deg = 0.0;  ///< of the smallest angles of all elements
  double least_angle_deg = 0.0;
  double share_within_20_pct = 0.0;  ///< of edges, against the size at their middle
  std::size_t edges = 0;
  std::size_t steps = 0;  ///< in which the bubbles came to rest, or were stopped
};

/// What could not be done as asked.
struct BubbleFlaw {
  enum class Kind {
    NotFinite,    ///< a corner is not a number; no mesh
    NoArea,       ///< nothing to fill; no mesh
    RingsCross,   ///< rings cut themselves or one another; no mesh
    BadSize,      ///< the size is not a positive length somewhere; no mesh
    TooMany,      ///< more vertices than allowed; no mesh
    Constraints,  ///< `length_m` of lines run too near to others to be followed
  };
  Kind kind;
  std::uint32_t polygon;
  double length_m = 0.0;

  bool is_refusal() const { return kind != Kind::Constraints; }
};

/// Name of a kind of flaw, as in `RingsCross`.
std::string_view name_of(BubbleFlaw::Kind kind);

/// Meshes of many polygons that conform to one another.
struct BubbleMesh {
  std::vector<PolygonMesh> meshes;   ///< [polygon] without elements where it was refused
  std::vector<MeshQuality> quality;  ///< [polygon]
  std::vector<BubbleFlaw> flaws;     ///< in the order of the polygons
};

/// Fills polygons with bubbles: on corners, then along edges and constraints, then inside, where
/// they push and pull one another into place; a constrained Delaunay triangulation of their centres
/// is the mesh.
///
/// Edges of polygons that lie on one another within the weld tolerance (`JoinTolerance` of all
/// corners), in whole or in part, carry the same vertices, bit for bit; no vertex lies on an edge
/// that it does not end.
///
/// Source   K. Shimada, D. C. Gossard, "Bubble mesh: automated triangular meshing of non-manifold
///          geometry by sphere packing", ACM Solid Modeling 1995: force and order of dimensions.
/// Threads  the polygons in parallel; the same bits for any number of threads.
///
/// @param size_at      at most as different at two places as a fraction of their distance, or
///                     shapes suffer
/// @param constraints  [polygon], in its plane; none at all, or as many as there are polygons
/// @throws InputError  numbers of constraints or of kept meshes that are not those of the polygons
BubbleMesh bubble_mesh(std::span<const FlatPolygon> polygons, const SizeAt& size_at,
                       std::span<const std::vector<ConstraintSegment>> constraints,
                       const BubbleOptions& options);

}  // namespace tenku
