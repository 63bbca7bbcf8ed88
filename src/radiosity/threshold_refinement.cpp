#include "radiosity/threshold_refinement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace tenku {
namespace {

constexpr std::size_t kFineness = 1000;  // steps of the threshold that are told apart

using Triangle = std::array<std::uint32_t, 3>;

/// An edge of an element, by its vertices.
struct Edge {
  std::uint32_t a, b, element;
  std::pair<std::uint32_t, std::uint32_t> key() const { return {a, b}; }
};

std::vector<Edge> sorted_edges(const ElementMesh& mesh) {
  std::vector<Edge> edges;
  for (std::uint32_t e = 0; e < mesh.size(); ++e) {
    for (unsigned k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(mesh.elements[e][k], mesh.elements[e][(k + 1) % 3]);
      edges.push_back({a, b, e});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& x, const Edge& y) { return x.key() < y.key(); });
  return edges;
}

/// Which element of `from` each one of `to` is; they differ in their order only.
std::vector<std::uint32_t> places(const std::vector<Triangle>& from,
                                  const std::vector<Triangle>& to) {
  std::map<Triangle, std::uint32_t> place;
  for (std::uint32_t e = 0; e < from.size(); ++e) place.emplace(from[e], e);
  std::vector<std::uint32_t> of;
  for (const Triangle& t : to) of.push_back(place.at(t));
  return of;
}

std::size_t elements_of(const std::vector<SplitMesh>& meshes) {
  std::size_t sum = 0;
  for (const SplitMesh& mesh : meshes) sum += mesh.conforming().elements.size();
  return sum;
}

}  // namespace

std::vector<double> neighbour_difference(const LightOnMesh& light) {
  std::vector<double> difference(light.mesh.size());
  const std::vector<Edge> edges = sorted_edges(light.mesh);
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    if (edges[k].key() != edges[k + 1].key()) continue;
    for (unsigned face = 0; face < 2; ++face) {
      const std::size_t a = 2 * std::size_t{edges[k].element} + face,
                        b = 2 * std::size_t{edges[k + 1].element} + face;
      if (light.is_lit[light.points.corner[a][0]] == 0) continue;
      const double here = std::abs(side_lux(light, a) - side_lux(light, b));
      for (const std::size_t side : {a, b}) {
        difference[side / 2] = std::max(difference[side / 2], here);
      }
    }
  }
  return difference;
}

ThresholdRefinement::ThresholdRefinement(std::span<const FlatPolygon> polygons,
                                         std::span<const MeshPiece> pieces)
    : polygons_(polygons) {
  for (const MeshPiece& piece : pieces) {
    split_.emplace_back(piece.mesh);
    shown_.push_back(places(piece.mesh.elements, piece.mesh.elements));
  }
}

std::vector<SplitMesh> ThresholdRefinement::split(std::span<const double> difference,
                                                  double threshold_lux) const {
  std::vector<SplitMesh> made = split_;
  std::size_t element = 0;
  for (std::size_t p = 0; p < made.size(); ++p) {
    std::vector<std::uint8_t> is_wanted(shown_[p].size());
    for (const std::uint32_t shown : shown_[p]) {
      is_wanted[shown] = difference[element++] > threshold_lux;
    }
    made[p].split(is_wanted);
  }
  return made;
}

double ThresholdRefinement::enough_lux(std::span<const double> difference, double threshold_lux,
                                       std::size_t elements_max) const {
  std::vector<double> sorted(difference.begin(), difference.end());
  sorted.push_back(threshold_lux);
  std::sort(sorted.begin(), sorted.end());
  // One of these splits too much, the last one nothing.
  auto low = static_cast<std::size_t>(
      std::lower_bound(sorted.begin(), sorted.end(), threshold_lux) - sorted.begin());
  std::size_t high = sorted.size() - 1;
  while (high - low > 1 + sorted.size() / kFineness) {
    const std::size_t middle = low + (high - low) / 2;
    (elements_of(split(difference, sorted[middle])) > elements_max ? low : high) = middle;
  }
  return sorted[high];
}

std::vector<MeshPiece> ThresholdRefinement::refined(std::span<const double> difference,
                                                    double threshold_lux, std::size_t elements_max,
                                                    double patch_m) {
  std::vector<SplitMesh> made = split(difference, threshold_lux);
  if (elements_max > 0 && elements_of(made) > elements_max) {
    made = split(difference, enough_lux(difference, threshold_lux, elements_max));
  }
  split_ = std::move(made);
  std::vector<MeshPiece> pieces;
  for (std::size_t p = 0; p < split_.size(); ++p) {
    const PolygonMesh& mesh = split_[p].conforming();
    PolygonMesh loose{mesh.vertices, mesh.elements, 1};
    pieces.push_back(grouped_piece(polygons_[p], std::move(loose), patch_m));
    shown_[p] = places(mesh.elements, pieces[p].mesh.elements);
  }
  return pieces;
}

}  // namespace tenku
