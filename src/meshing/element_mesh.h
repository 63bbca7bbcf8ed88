/// Surfaces divided for radiosity: patches, which shoot, of elements, which receive.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/vec3.h"
#include "scene/material.h"

namespace tenku {

/// Glass between surfaces: it has no elements, but light between them loses what it holds back.
///
/// Shape    `corner` and `material` [triangle].
struct MeshPanes {
  std::vector<std::array<Vec3, 3>> corner;
  std::vector<std::uint32_t> material;  ///< index into `materials`
  std::vector<Material> materials;

  bool empty() const { return corner.empty(); }
};

/// Flat pieces of surface with two faces each.
///
/// Both faces of a thin wall receive and shoot, each for itself: a *side* is an element (or a
/// patch) and one of its faces, with the number 2 i for the front and 2 i + 1 for the back of i.
/// Nothing then depends on how a file orients its polygons.
///
/// Frame    local east, north, up; the front is the face from which vertices run counter-clockwise.
/// Units    metres.
/// Shape    per-element arrays [element]; elements of a patch follow one another, lie in one plane
///          and have one material.
struct ElementMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> elements;
  std::vector<std::uint32_t> material;        ///< of each element
  std::vector<std::uint32_t> object;          ///< of each element, index into `Scene::objects`
  std::vector<std::uint32_t> patch_begin{0};  ///< first element of each patch, and the end
  MeshPanes panes;

  std::size_t size() const { return elements.size(); }
  std::size_t patches() const { return patch_begin.size() - 1; }
  std::size_t sides() const { return 2 * elements.size(); }

  /// Twice the area of an element, along the normal of its front.
  Vec3 doubled_area(std::size_t element) const;
  double area_m2(std::size_t element) const { return 0.5 * length(doubled_area(element)); }
  double patch_area_m2(std::size_t patch) const;
  Vec3 centre(std::size_t element) const;
  /// Mean length of the edges of an element.
  double mean_edge_m(std::size_t element) const;
  /// Unit normal of a side.
  Vec3 normal(std::size_t side) const;
};

}  // namespace tenku
