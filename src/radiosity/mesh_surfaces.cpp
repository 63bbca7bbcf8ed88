#include "radiosity/mesh_surfaces.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/extent.h"
#include "core/parallel.h"
#include "radiosity/flat_polygon.h"
#include "radiosity/patch_groups.h"
#include "radiosity/polygon_mesh.h"

namespace tenku {
namespace {

constexpr double kElementsAcross = 32.0;
constexpr std::size_t kElementsUnasked = 50'000;
constexpr double kPatchOfElement = 2.0;

/// A polygon divided, and the number of elements of each of its patches.
struct Piece {
  PolygonMesh mesh;
  std::vector<std::size_t> patches;
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

double size_for(const std::vector<FlatPolygon>& polygons, double longest, double elements) {
  double low = 0.0, high = longest;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (expected_elements(polygons, middle) > elements ? low : high) = middle;
  }
  return high;
}

MeshOptions sized(const std::vector<FlatPolygon>& polygons, double longest, MeshOptions options) {
  if (!(options.element_m > 0.0)) {
    const std::size_t most = options.elements_max > 0 ? options.elements_max : kElementsUnasked;
    options.element_m = size_for(polygons, longest, static_cast<double>(most));
    if (options.elements_max == 0) {
      options.element_m = std::max(options.element_m, longest / kElementsAcross);
    }
    options.element_m = std::max(options.element_m, options.element_min_m);
  }
  if (!(options.patch_m > 0.0)) options.patch_m = kPatchOfElement * options.element_m;
  return options;
}

Piece divided(const FlatPolygon& polygon, const MeshOptions& sizes, double apart_m) {
  Piece piece;
  auto grid = grid_mesh(polygon, sizes.element_m, apart_m);
  piece.mesh = grid ? std::move(*grid) : delaunay_mesh(polygon, sizes.element_m);
  piece.patches = group_patches(polygon, piece.mesh, sizes.patch_m);
  return piece;
}

void append(const FlatPolygon& polygon, const Piece& piece, ElementMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), piece.mesh.vertices.begin(), piece.mesh.vertices.end());
  for (const auto& [a, b, c] : piece.mesh.elements) {
    mesh.elements.push_back({first + a, first + b, first + c});
  }
  mesh.material.resize(mesh.size(), polygon.material);
  mesh.object.resize(mesh.size(), polygon.object);
  for (const std::size_t n : piece.patches) {
    mesh.patch_begin.push_back(mesh.patch_begin.back() + static_cast<std::uint32_t>(n));
  }
}

double longest_side(const TriangleSoup& soup) {
  return soup.vertices.empty() ? 0.0 : extent_of(soup.vertices).longest_side();
}

}  // namespace

MeshOptions chosen_sizes(const TriangleSoup& soup, std::span<const Material> materials,
                         const MeshOptions& options) {
  check(soup, materials, options);
  const auto polygons = join_coplanar(soup, materials, JoinTolerance::of(soup.vertices));
  return sized(polygons, longest_side(soup), options);
}

ElementMesh mesh_surfaces(const TriangleSoup& soup, std::span<const Material> materials,
                          const MeshOptions& options) {
  check(soup, materials, options);
  const JoinTolerance tolerance = JoinTolerance::of(soup.vertices);
  const auto polygons = join_coplanar(soup, materials, tolerance);
  const MeshOptions sizes = sized(polygons, longest_side(soup), options);
  std::vector<Piece> pieces(polygons.size());
  parallel_for(polygons.size(), 16, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      pieces[i] = divided(polygons[i], sizes, 2.0 * tolerance.weld_m);
    }
  });
  ElementMesh mesh;
  for (std::size_t i = 0; i < polygons.size(); ++i) append(polygons[i], pieces[i], mesh);
  return mesh;
}

}  // namespace tenku
