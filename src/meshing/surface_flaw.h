/// What radiosity bears badly in a scene's surfaces, and where it is.
#pragma once

#include <cstdint>
#include <vector>

#include "core/finding.h"
#include "core/vec3.h"
#include "scene/scene.h"

namespace tenku {

/// One flaw. Which codes, sentences and advice they give: `findings_of`.
struct SurfaceFlaw {
  enum class Kind {
    NoArea,      ///< a triangle without width
    Duplicate,   ///< a surface in the place of another of its material, left out
    Coincident,  ///< a surface in the place of one of another material, of `other`; left out
    Overlap,     ///< a surface that lies on a part of another, of `other`
    Gap,         ///< an edge that stops `size_m` before the surface of `other`
    Sliver,      ///< a polygon that is `size_m` wide
    Coarse,      ///< elements of which one is `size_m` wide, too little for 32-bit floats there
  };
  Kind kind;
  std::uint32_t object;
  Vec3 where;
  double size_m = 0.0;
  std::uint32_t other = kNone;
};

/// One finding for each kind, with the place and object of the first flaw and the number of all:
/// ids as in the file, places in its coordinates.
std::vector<Finding> findings_of(const std::vector<SurfaceFlaw>& flaws, const Scene& scene);

}  // namespace tenku
