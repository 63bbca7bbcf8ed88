/// Triangles of a scene that can be divided.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshing/surface_flaw.h"
#include "scene/material.h"
#include "scene/triangle_soup.h"

namespace tenku {

/// A triangle with area, its corners by index after welding.
struct Face {
  std::array<std::uint32_t, 3> corner;
  std::uint32_t triangle, material, object;
  Vec3 doubled_area;

  bool is_like(const Face& other) const {
    return material == other.material && object == other.object;
  }
};

/// Triangles that are not glass and have area, by their place in the soup. Of those with the same
/// corners only the first.
/// @param weld   [vertex of the soup] the one that stands for it
/// @param flaws  receives what is left out
std::vector<Face> faces_of(const TriangleSoup& soup, std::span<const Material> materials,
                           std::span<const std::uint32_t> weld, double weld_m,
                           std::vector<SurfaceFlaw>& flaws);

}  // namespace tenku
