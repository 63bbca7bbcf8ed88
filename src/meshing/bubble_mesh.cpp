#include "meshing/bubble_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "meshing/bubble_constraints.h"
#include "meshing/bubble_edges.h"
#include "meshing/bubble_motion.h"
#include "meshing/bubble_place.h"
#include "meshing/bubble_triangles.h"
#include "meshing/mesh_quality.h"
#include "meshing/short_pieces.h"

namespace tenku {
namespace {

// Of motion, and between them of taking bubbles out and putting others in; then of the latter
// alone.
constexpr std::size_t kRounds = 3, kRepairs = 4;

/// Fills one polygon whose edges are filled.
class FaceMesher {
 public:
  FaceMesher(const FlatPolygon& polygon, const EdgeBubbles& edges, std::size_t number,
             const BubbleOptions& options)
      : polygon_(polygon), edges_(edges), number_(number), options_(options) {}

  /// @return  why there is no mesh
  std::optional<BubbleFlaw::Kind> fill(const SizeAt& size_at,
                                       std::span<const ConstraintSegment> constraints) {
    const auto wanted = [&](PlanePoint p) { return size_at(number_, p); };
    face_.size_at = wanted;
    add_rings();
    if (!std::all_of(face_.size_m.begin(), face_.size_m.end(), is_size)) {
      return BubbleFlaw::Kind::BadSize;
    }
    if (const auto refusal = turn_pieces()) return refusal;
    lost_m_ = add_constraints(face_, constraints, options_.vertices_most);
    const ShortPieces short_pieces(face_);
    if (!short_pieces.empty()) {
      face_.size_at = [&](PlanePoint p) { return short_pieces.limited(p, wanted(p)); };
      for (std::size_t i = 0; i < face_.fixed; ++i) face_.size_m[i] = face_.size_at(face_.at[i]);
    }
    BubblePlacer(face_, expected()).fill(options_.vertices_most);
    if (face_.at.size() >= options_.vertices_most) return BubbleFlaw::Kind::TooMany;
    const auto mesh = settled();
    if (!mesh) return BubbleFlaw::Kind::RingsCross;
    make_mesh(*mesh);
    quality_ = mesh_quality(polygon_, made_, wanted);
    quality_.steps = steps_;
    return std::nullopt;
  }

  PolygonMesh mesh() { return std::move(made_); }
  MeshQuality quality() const { return quality_; }
  double lost_m() const { return lost_m_; }

 private:
  void add_rings() {
    std::map<std::uint32_t, std::uint32_t> fixed;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> passes;
    for (const auto& ring : edges_.rings[number_]) {
      std::vector<std::uint32_t> chain;
      for (const std::uint32_t v : ring) {
        const auto [at, is_new] = fixed.try_emplace(v, face_.at.size());
        if (is_new) {
          const PlanePoint p = polygon_.flat(edges_.places[v]);
          face_.add(p, face_.size_at(p));
          places_.push_back(edges_.places[v]);
        }
        chain.push_back(at->second);
      }
      for (std::size_t k = 0; k < chain.size(); ++k) {
        const auto key = std::minmax(chain[k], chain[(k + 1) % chain.size()]);
        if (key.first != key.second) ++passes[key];
      }
    }
    for (const auto& [edge, n] : passes) {
      if (n % 2 == 1) face_.pieces.push_back({edge.first, edge.second, true});
    }
    face_.fixed = face_.at.size();
  }

  /// Turns the pieces of the outline so that the surface is to their left.
  std::optional<BubbleFlaw::Kind> turn_pieces() {
    if (face_.pieces.empty()) return BubbleFlaw::Kind::NoArea;
    const auto mesh = triangulate(face_);
    if (!mesh) return BubbleFlaw::Kind::RingsCross;
    if (mesh->triangles.empty()) return BubbleFlaw::Kind::NoArea;
    std::vector<BubblePiece> turned;
    for (const auto& t : mesh->triangles) {
      for (unsigned k = 0; k < 3; ++k) {
        if (t.is_piece[k]) turned.push_back({t.corner[(k + 1) % 3], t.corner[(k + 2) % 3], true});
      }
    }
    // A piece that is parted by a bubble on it gives others than were put in.
    const auto key = [](const BubblePiece& p) {
      return std::pair(std::min(p.a, p.b), std::max(p.a, p.b));
    };
    std::sort(turned.begin(), turned.end(),
              [&](const auto& p, const auto& q) { return key(p) < key(q); });
    const bool are_whole =
        std::equal(turned.begin(), turned.end(), face_.pieces.begin(), face_.pieces.end(),
                   [&](const auto& p, const auto& q) { return key(p) == key(q); });
    if (!are_whole) return BubbleFlaw::Kind::RingsCross;
    face_.pieces = std::move(turned);
    return std::nullopt;
  }

  /// Number of bubbles that the size at the outline lets expect.
  std::size_t expected() const {
    double inverse = 0.0;
    for (const double size : face_.size_m) inverse += 1.0 / (size * size);
    const double inner = 1.2 * polygon_.area_m2 * inverse / static_cast<double>(face_.at.size());
    return face_.at.size() + static_cast<std::size_t>(std::clamp(
                                 inner, 0.0, 1e-2 * static_cast<double>(options_.vertices_most)));
  }

  /// Triangles between the bubbles when they have come to rest.
  std::optional<BubbleTriangles> settled() {
    std::optional<BubbleTriangles> mesh;
    for (std::size_t round = 0; round < kRounds + kRepairs; ++round) {
      if (round < kRounds) {
        steps_ += move_bubbles(face_, options_.steps_most / kRounds, options_.motion);
      }
      mesh = triangulate(face_);
      if (!mesh || correct_population(face_, *mesh) == 0) return mesh;
    }
    return triangulate(face_);
  }

  void make_mesh(const BubbleTriangles& mesh) {
    std::vector<std::uint32_t> number(face_.at.size());
    for (std::size_t i = 0; i < face_.at.size(); ++i) {
      number[i] = static_cast<std::uint32_t>(made_.vertices.size());
      if (mesh.is_used[i] == 0) continue;
      made_.vertices.push_back(i < places_.size() ? places_[i] : polygon_.lifted(face_.at[i]));
    }
    for (const auto& t : mesh.triangles) {
      made_.elements.push_back({number[t.corner[0]], number[t.corner[1]], number[t.corner[2]]});
    }
  }

  const FlatPolygon& polygon_;
  const EdgeBubbles& edges_;
  std::size_t number_;
  const BubbleOptions& options_;
  BubbleFace face_;
  std::vector<Vec3> places_;  ///< of the bubbles on the outline
  PolygonMesh made_;
  MeshQuality quality_;
  std::size_t steps_ = 0;
  double lost_m_ = 0.0;
};

void check(std::span<const FlatPolygon> polygons,
           std::span<const std::vector<ConstraintSegment>> constraints,
           const BubbleOptions& options) {
  if (!constraints.empty() && constraints.size() != polygons.size()) {
    throw InputError("constraints should be given for each polygon, or for none");
  }
  if (!options.kept.empty() && options.kept.size() != polygons.size()) {
    throw InputError("meshes to keep should be given for each polygon, or for none");
  }
}

}  // namespace

std::string_view name_of(BubbleFlaw::Kind kind) {
  switch (kind) {
    case BubbleFlaw::Kind::NotFinite:
      return "NotFinite";
    case BubbleFlaw::Kind::NoArea:
      return "NoArea";
    case BubbleFlaw::Kind::RingsCross:
      return "RingsCross";
    case BubbleFlaw::Kind::BadSize:
      return "BadSize";
    case BubbleFlaw::Kind::TooMany:
      return "TooMany";
    case BubbleFlaw::Kind::Constraints:
      return "Constraints";
  }
  return "";
}

BubbleMesh bubble_mesh(std::span<const FlatPolygon> polygons, const SizeAt& size_at,
                       std::span<const std::vector<ConstraintSegment>> constraints,
                       const BubbleOptions& options) {
  check(polygons, constraints, options);
  EdgeBubbles edges = fill_edges(polygons, size_at, options);
  BubbleMesh made;
  made.meshes.resize(polygons.size());
  made.quality.resize(polygons.size());
  std::vector<double> lost_m(polygons.size());
  parallel_for(polygons.size(), 1, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (!options.kept.empty() && !options.kept[i].elements.empty()) {
        made.meshes[i] = options.kept[i];
        made.quality[i] =
            mesh_quality(polygons[i], made.meshes[i], [&](PlanePoint p) { return size_at(i, p); });
        continue;
      }
      if (edges.refusal[i]) continue;
      FaceMesher mesher(polygons[i], edges, i, options);
      const std::span<const ConstraintSegment> lines =
          constraints.empty() ? std::span<const ConstraintSegment>() : constraints[i];
      edges.refusal[i] = mesher.fill(size_at, lines);
      if (edges.refusal[i]) continue;
      lost_m[i] = mesher.lost_m();
      made.quality[i] = mesher.quality();
      made.meshes[i] = mesher.mesh();
    }
  });
  for (std::uint32_t i = 0; i < polygons.size(); ++i) {
    if (edges.refusal[i]) made.flaws.push_back({*edges.refusal[i], i});
    if (lost_m[i] > 0.0) made.flaws.push_back({BubbleFlaw::Kind::Constraints, i, lost_m[i]});
  }
  return made;
}

}  // namespace tenku
