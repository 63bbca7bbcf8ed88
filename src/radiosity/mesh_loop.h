/// Mesh, solution, better mesh, solution: until the mesh suits the light.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/finding.h"
#include "core/progress.h"
#include "meshing/bubble_mesh.h"
#include "meshing/mesh_pieces.h"
#include "meshing/mesh_surfaces.h"
#include "meshing/size_field.h"
#include "radiosity/interior.h"
#include "radiosity/light_on_mesh.h"
#include "radiosity/shadow_edges.h"
#include "radiosity/sizes_by_change.h"
#include "radiosity/sizes_by_error.h"
#include "radiosity/threshold_refinement.h"

namespace tenku {

/// `--mesh uniform|refine|bubble`.
enum class Mesher { Uniform, Refine, Bubble };

/// @throws InputError for any other name
Mesher mesher_named(std::string_view name);

/// What the mesh is to become.
struct MeshLoopOptions {
  Mesher mesher = Mesher::Uniform;
  /// Root mean square of what interpolation on the mesh misses, percent of the mean illuminance.
  double tolerance_pct = 2.0;
  /// For bubbles, metres, 0 where it is not given. Both: by hand (`sizes_by_change`). One: bound of
  /// the sizes that the tolerance gives.
  SizeRange sizes{0.0, 0.0};
  std::size_t elements_max = 0;  ///< 0: as many as the tolerance takes, below a million
  double threshold_pct = 0.0;    ///< for `Refine`, of the mean illuminance; 0: the tolerance
  double grading = 0.35;         ///< of the sizes of bubbles, metres per metre
  int rounds = 3;                ///< meshes after the first, at most
  /// [polygon] lines that edges of bubble meshes follow, and which part them where things touch; or
  /// none at all.
  std::vector<ShadowEdges> edges{};
};

/// One mesh that was solved.
struct MeshRound {
  std::size_t elements = 0;
  std::size_t polygons_meshed = 0;  ///< anew
  std::size_t points_kept = 0;      ///< whose form factors are those of the mesh before
  double missed_pct = 0.0;          ///< root mean square, as in the options, as estimated
  MeshQuality quality{};            ///< of the polygons meshed by bubbles, if any
};

/// The calculation with the mesh that it has come to.
///
/// A polygon is meshed anew where a tenth of the elements that the light asks for have another size
/// than those that are there. With sizes by hand there is one round, as in the source; otherwise
/// rounds go on until the tolerance holds or nothing is to be gained.
///
/// Source   for bubbles: T. Itoh et al. (sizes_by_change.h); for `Refine`: threshold_refinement.h
class MeshLoop {
 public:
  /// @param materials  kept by reference
  /// @throws InputError  least above most size, no rounds, a tolerance that is not positive
  MeshLoop(MeshedScene first, const std::vector<Material>& materials, InteriorOptions interior,
           MeshLoopOptions options);

  /// Solves, and meshes and solves again.
  /// @throws Cancelled
  void run(const LightRequest& request, Progress& progress);

  const ElementMesh& mesh() const { return *mesh_; }
  std::span<const FlatPolygon> polygons() const { return polygons_; }
  std::span<const std::uint32_t> polygon_of() const { return polygon_of_; }  ///< [element]
  Interior& interior() { return *interior_; }
  const Interior& interior() const { return *interior_; }
  /// Of the last round.
  const InteriorLight& light() const { return light_; }
  const std::vector<MeshRound>& rounds() const { return rounds_; }
  /// Of all rounds.
  InteriorTimes times() const;
  double size_field_s() const { return size_field_s_; }
  double remesh_s() const { return remesh_s_; }
  /// Size that was asked for at each vertex, metres; empty where none was.
  std::vector<double> asked_size_m() const;
  /// Of the last meshing: `polygons_not_meshed_anew`, `shadow_edges_left_out`.
  const std::vector<Finding>& findings() const { return findings_; }

 private:
  void solve(const LightRequest& request, Progress& progress);
  bool is_enough() const;
  bool remesh(Progress& progress);
  bool remesh_by_threshold();
  bool remesh_by_bubbles(Progress& progress);
  using Samples = std::vector<SizeSample>;  ///< of one polygon
  std::vector<Samples> samples_at_vertices(std::span<const double> size_m) const;
  std::vector<Samples> samples_in_elements(std::span<const double> size_m) const;
  void make_fields(const std::vector<Samples>& samples, SizeRange range);
  std::vector<std::uint8_t> polygons_to_mesh() const;
  BubbleMesh bubbles(std::span<const std::uint8_t> is_wanted, double scale) const;
  double foreseen_elements() const;
  /// Not more elements than are allowed; where that is too few for the sizes, nearly as many.
  BubbleMesh bubbles_up_to(std::span<const std::uint8_t> is_wanted);
  void take(std::vector<MeshPiece> pieces);
  /// The number in another mesh of each side of those polygons that have the same elements there.
  std::vector<std::uint32_t> sides_in(std::span<const MeshPiece> pieces) const;
  bool has_sizes_by_hand() const {
    return options_.sizes.least_m > 0.0 && options_.sizes.most_m > 0.0;
  }

  const std::vector<Material>& materials_;
  InteriorOptions how_;
  MeshLoopOptions options_;
  double asked_pct_;  ///< of the mean illuminance: with which the tolerance should hold
  std::vector<FlatPolygon> polygons_;
  std::vector<std::uint32_t> polygon_of_;
  double patch_m_, longest_m_ = 0.0;
  std::unique_ptr<ElementMesh> mesh_;
  std::unique_ptr<Interior> interior_;
  InteriorLight light_;
  std::optional<LightOnMesh> on_mesh_;  ///< of `light_`
  std::vector<std::uint8_t> is_bent_;   ///< [element], edges that follow lines
  std::vector<InterpolationError> missed_lux_;
  std::vector<PointGather::Kept> kept_rows_;  ///< of the mesh before
  std::unique_ptr<ThresholdRefinement> refinement_;
  std::vector<std::vector<ConstraintSegment>> constraints_;  ///< [polygon], or none
  std::vector<SizeField> field_;                             ///< [polygon]
  std::vector<MeshRound> rounds_;
  std::vector<Finding> findings_;
  double coarser_ = 1.0;  ///< than foreseen: sizes that gave the number of elements allowed
  double power_ = 2.0;    ///< of sizes, as which the number of elements falls
  InteriorTimes before_;  ///< of the rounds before this one
  double size_field_s_ = 0.0, remesh_s_ = 0.0;
};

}  // namespace tenku
