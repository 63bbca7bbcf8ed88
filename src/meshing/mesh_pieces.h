/// The mesh of a scene as pieces, one for each polygon, that can be replaced one by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshing/element_mesh.h"
#include "meshing/polygon_mesh.h"

namespace tenku {

/// A polygon divided, and the number of elements of each of its patches, in their order.
struct MeshPiece {
  PolygonMesh mesh;
  std::vector<std::size_t> patches;
};

/// A piece of elements that are not grouped yet.
/// @param patch_m  longest diagonal of a patch
MeshPiece grouped_piece(const FlatPolygon& polygon, PolygonMesh mesh, double patch_m);

/// Which polygon each element is a part of.
struct AssembledMesh {
  ElementMesh mesh;
  std::vector<std::uint32_t> polygon_of;  ///< [element], in rising order
};

/// All pieces in one mesh, in the order of the polygons; those of the same polygon are equal bit by
/// bit wherever the others change.
/// @param pieces  [polygon]
AssembledMesh assembled(std::span<const FlatPolygon> polygons, std::span<const MeshPiece> pieces);

/// The pieces that a mesh was put together from.
/// @param polygon_of  [element], in rising order
/// @param polygons    their number
std::vector<MeshPiece> pieces_of(const ElementMesh& mesh, std::span<const std::uint32_t> polygon_of,
                                 std::size_t polygons);

}  // namespace tenku
