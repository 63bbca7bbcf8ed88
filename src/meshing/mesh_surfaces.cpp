#include "meshing/mesh_surfaces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/extent.h"
#include "core/parallel.h"
#include "meshing/flat_polygon.h"
#include "meshing/mesh_pieces.h"
#include "meshing/mesh_soup.h"
#include "meshing/polygon_mesh.h"
#include "meshing/surface_checks.h"
#include "meshing/surface_flaw.h"

namespace tenku {
namespace {

constexpr double kElementsAcross = 32.0, kUsualTolerance = 2.0;  // at that tolerance
constexpr double kCoarsening = 0.75, kFinest = 0.5, kCoarsest = 4.0;
constexpr double kElementsUnasked = 50'000.0;
constexpr double kPatchOfElement = 2.0;
constexpr double kMostElements = 1e8;  // 10 GB with what belongs to them

/// A mesh and what it was made of.
struct Meshed {
  JoinedSurfaces surfaces;
  JoinTolerance tolerance;
  MeshOptions sizes;
  ElementMesh mesh;
  std::vector<std::uint32_t> polygon_of;  ///< [element]
};

void check(const TriangleSoup& soup, std::span<const Material> materials,
           const MeshOptions& options) {
  const auto length = [](const char* name, double value) {
    if (!(value >= 0.0 && std::isfinite(value))) {
      throw InputError(std::string(name) + " of " + std::to_string(value) +
                       " m should be a length, or 0 to have it chosen");
    }
  };
  length("the size of elements", options.element_m);
  length("the least size of elements", options.element_min_m);
  length("the size of patches", options.patch_m);
  for (const std::uint32_t m : soup.material) {
    if (m >= materials.size()) throw InputError("a triangle has a material that is not there");
  }
}

/// Number of elements to be expected of edges up to `element_m`.
double expected_elements(const std::vector<FlatPolygon>& polygons, double element_m) {
  double sum = 0.0;
  for (const FlatPolygon& p : polygons) {
    double around = 0.0, corners = 0.0;
    for (const auto& ring : p.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        around += length(ring[(i + 1) % ring.size()] - ring[i]);
        corners += 1.0;
      }
    }
    // Two triangles to a square of this diagonal, one to a step along the edge, and the least.
    sum += 4.0 * p.area_m2 / (element_m * element_m) + 0.5 * around / element_m + corners - 2.0;
  }
  return sum;
}

/// Longest edge with which not more elements than these are to be expected.
double size_for(const std::vector<FlatPolygon>& polygons, double longest, double elements) {
  double low = 0.0, high = longest;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (expected_elements(polygons, middle) > elements ? low : high) = middle;
  }
  return high;
}

double chosen_size(const std::vector<FlatPolygon>& polygons, double longest,
                   const MeshOptions& options) {
  // No edge is longer than the box's diagonal.
  const double undivided = 2.0 * longest;
  if (options.elements_max > 0) {
    return size_for(polygons, undivided, static_cast<double>(options.elements_max));
  }
  const double most = kElementsUnasked + expected_elements(polygons, undivided);
  // What linear interpolation misses goes with the square of the length.
  const double coarser = std::pow(options.tolerance_pct / kUsualTolerance, kCoarsening);
  const double across = kElementsAcross / std::clamp(coarser, kFinest, kCoarsest);
  return std::max(longest / across, size_for(polygons, undivided, most));
}

MeshOptions sized(const std::vector<FlatPolygon>& polygons, double longest, MeshOptions options) {
  if (!(options.element_m > 0.0)) {
    options.element_m = std::max(chosen_size(polygons, longest, options), options.element_min_m);
  }
  const double expected = expected_elements(polygons, options.element_m);
  if (expected > kMostElements) {
    throw InputError("elements of " + std::to_string(options.element_m) + " m would be about " +
                     std::to_string(static_cast<long long>(expected)) +
                     "; choose a larger size, or a number of elements");
  }
  return options;
}

PolygonMesh divided(const FlatPolygon& polygon, double element_m, const JoinTolerance& tolerance) {
  auto grid = grid_mesh(polygon, element_m, 2.0 * tolerance.weld_m);
  return grid ? std::move(*grid) : delaunay_mesh(polygon, element_m);
}

/// Whether a mesh covers what the polygon's triangles do, which it cannot where they overlap.
bool covers(const PolygonMesh& mesh, const FlatPolygon& polygon, double weld_m) {
  double area = 0.0, around = 0.0;
  for (const auto& [a, b, c] : mesh.elements) {
    area += 0.5 *
            length(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
  }
  for (const auto& ring : polygon.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      around += length(ring[(i + 1) % ring.size()] - ring[i]);
    }
  }
  constexpr double kRounding = 1e-6;
  return std::abs(area - polygon.area_m2) <= kRounding * polygon.area_m2 + weld_m * around;
}

MeshPiece piece_of(const FlatPolygon& polygon, const MeshOptions& sizes,
                   const JoinTolerance& tolerance) {
  return grouped_piece(polygon, divided(polygon, sizes.element_m, tolerance), sizes.patch_m);
}

class Mesher {
 public:
  Mesher(const TriangleSoup& soup, std::span<const Material> materials) : soup_(soup) {
    made_.tolerance = JoinTolerance::of(soup.vertices);
    made_.surfaces = join_coplanar(soup, materials, made_.tolerance);
    if (!soup.vertices.empty()) longest_ = extent_of(soup.vertices).longest_side();
  }

  Meshed meshed(const MeshOptions& options) {
    const auto& polygons = made_.surfaces.polygons;
    if (polygons.empty()) return std::move(made_);
    made_.sizes = sized(polygons, longest_, options);
    const auto most = static_cast<double>(options.elements_max);
    for (;;) {
      if (!(options.patch_m > 0.0)) made_.sizes.patch_m = kPatchOfElement * made_.sizes.element_m;
      divide();
      const auto count = static_cast<double>(made_.mesh.size());
      const bool can_be_longer = made_.sizes.element_m < 2.0 * longest_;
      if (options.elements_max == 0 || count <= most || !can_be_longer) return std::move(made_);
      made_.sizes.element_m *= std::max(1.02, std::sqrt(count / most));
    }
  }

 private:
  void divide() {
    split_overlapping();
    AssembledMesh all = assembled(made_.surfaces.polygons, pieces_);
    made_.mesh = std::move(all.mesh);
    made_.polygon_of = std::move(all.polygon_of);
  }

  void make_pieces(std::size_t begin) {
    const auto& polygons = made_.surfaces.polygons;
    pieces_.resize(begin);
    pieces_.resize(polygons.size());
    parallel_for(polygons.size() - begin, 16, [&](IndexRange range) {
      for (std::size_t i = begin + range.begin; i < begin + range.end; ++i) {
        pieces_[i] = piece_of(polygons[i], made_.sizes, made_.tolerance);
      }
    });
  }

  /// Divides all polygons; where triangles overlap each becomes a polygon of its own.
  void split_overlapping() {
    auto& polygons = made_.surfaces.polygons;
    make_pieces(0);
    std::vector<FlatPolygon> kept, apart;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      const bool is_whole = polygons[i].triangles.size() == 1 ||
                            covers(pieces_[i].mesh, polygons[i], made_.tolerance.weld_m);
      if (is_whole) {
        if (!apart.empty()) pieces_[kept.size()] = std::move(pieces_[i]);
        kept.push_back(std::move(polygons[i]));
        continue;
      }
      for (const std::uint32_t t : polygons[i].triangles) {
        apart.push_back(triangle_polygon(soup_, made_.surfaces.weld, t));
      }
    }
    const std::size_t whole = kept.size();
    polygons = std::move(kept);
    polygons.insert(polygons.end(), std::make_move_iterator(apart.begin()),
                    std::make_move_iterator(apart.end()));
    make_pieces(whole);
  }

  const TriangleSoup& soup_;
  double longest_ = 0.0;
  Meshed made_;
  std::vector<MeshPiece> pieces_;
};

Finding too_many(std::size_t allowed, std::size_t polygons, std::size_t elements) {
  Finding finding;
  finding.code = "elements_max_passed";
  finding.what = "the scene has " + std::to_string(polygons) + " flat polygons, which give " +
                 std::to_string(elements) + " elements undivided, more than the " +
                 std::to_string(allowed) + " allowed";
  finding.repair = "none is divided; leave small things out of the scene, or allow more elements";
  return finding;
}

}  // namespace

MeshedScene mesh_scene(const Scene& scene, const TriangleSoup& soup, const MeshOptions& options) {
  check(soup, scene.materials, options);
  Meshed meshed = Mesher(soup, scene.materials).meshed(options);
  std::vector<SurfaceFlaw> flaws = std::move(meshed.surfaces.flaws);
  const auto more =
      check_surfaces(meshed.surfaces.polygons, meshed.mesh, meshed.polygon_of, meshed.tolerance);
  flaws.insert(flaws.end(), more.begin(), more.end());
  MeshedScene made{std::move(meshed.mesh), meshed.sizes, findings_of(flaws, scene),
                   std::move(meshed.surfaces.polygons), std::move(meshed.polygon_of)};
  made.mesh.panes = panes_of(soup, scene.materials);
  if (options.elements_max > 0 && made.mesh.size() > options.elements_max) {
    made.findings.push_back(too_many(options.elements_max, made.polygons.size(), made.mesh.size()));
  }
  return made;
}

ElementMesh mesh_surfaces(const TriangleSoup& soup, std::span<const Material> materials,
                          const MeshOptions& options) {
  check(soup, materials, options);
  ElementMesh mesh = Mesher(soup, materials).meshed(options).mesh;
  mesh.panes = panes_of(soup, materials);
  return mesh;
}

}  // namespace tenku
