#include "meshing/mesh_pieces.h"

#include <unordered_map>
#include <utility>

#include "core/error.h"
#include "meshing/patch_groups.h"

namespace tenku {
namespace {

void append(const FlatPolygon& polygon, const MeshPiece& piece, ElementMesh& mesh) {
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

}  // namespace

MeshPiece grouped_piece(const FlatPolygon& polygon, PolygonMesh mesh, double patch_m) {
  MeshPiece piece{std::move(mesh), {}};
  piece.patches = group_patches(polygon, piece.mesh, patch_m);
  return piece;
}

AssembledMesh assembled(std::span<const FlatPolygon> polygons, std::span<const MeshPiece> pieces) {
  expects(polygons.size() == pieces.size(), "every polygon has a piece");
  AssembledMesh all;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    append(polygons[i], pieces[i], all.mesh);
    all.polygon_of.resize(all.mesh.size(), static_cast<std::uint32_t>(i));
  }
  return all;
}

std::vector<MeshPiece> pieces_of(const ElementMesh& mesh, std::span<const std::uint32_t> polygon_of,
                                 std::size_t polygons) {
  std::vector<MeshPiece> pieces(polygons);
  std::vector<std::unordered_map<std::uint32_t, std::uint32_t>> number(polygons);
  for (std::size_t p = 0; p < mesh.patches(); ++p) {
    const std::uint32_t begin = mesh.patch_begin[p], end = mesh.patch_begin[p + 1];
    MeshPiece& piece = pieces[polygon_of[begin]];
    piece.patches.push_back(end - begin);
    for (std::uint32_t e = begin; e < end; ++e) {
      auto& known = number[polygon_of[begin]];
      auto element = mesh.elements[e];
      for (std::uint32_t& corner : element) {
        const auto next = static_cast<std::uint32_t>(piece.mesh.vertices.size());
        const auto [found, is_new] = known.emplace(corner, next);
        if (is_new) piece.mesh.vertices.push_back(mesh.vertices[corner]);
        corner = found->second;
      }
      piece.mesh.elements.push_back(element);
    }
  }
  return pieces;
}

}  // namespace tenku
