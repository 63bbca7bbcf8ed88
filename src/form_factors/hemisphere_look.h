/// What a point sees, sampled by rays.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/vec3.h"
#include "form_factors/form_factor.h"
#include "meshing/element_mesh.h"
#include "meshing/mesh_soup.h"
#include "visibility/ray_visibility.h"

namespace tenku {

/// A ray that met a side of an element.
struct MetSide {
  std::uint32_t side;
  double share;    ///< of what comes by the ray: what panes do not hold, by the number of rays
  Vec3 direction;  ///< of the ray
};

/// A mesh ready to be met by rays.
///
/// Threads  immutable after construction; may be shared.
struct MeshRays {
  const ElementMesh& mesh;
  MeshSoup soup;
  RayVisibility rays;
  std::vector<Vec3> normal;  ///< of the front of each element, of any length

  /// @param mesh  kept by reference
  explicit MeshRays(const ElementMesh& mesh);

  /// What a ray meets first, with the share that panes let through.
  /// @param position  off the surface that it lies on
  std::optional<MetSide> first_met(Vec3 position, Vec3 direction) const;
  /// The same where the element that it meets is known.
  MetSide met(Vec3 position, Vec3 direction, std::uint32_t element) const;
  /// Where a ray from `position` met the plane of the element.
  Vec3 place(Vec3 position, const MetSide& met) const {
    return position + away(position, met.direction, met.side / 2) * met.direction;
  }

 private:
  /// To the plane of an element, in lengths of `direction`.
  double away(Vec3 position, Vec3 direction, std::uint32_t element) const {
    const Vec3 face = normal[element], corner = mesh.vertices[mesh.elements[element][0]];
    return dot(face, corner - position) / dot(direction, face);
  }
};

/// The disc sampled by rays, one in each cell of a grid. Each point takes one of a few patterns of
/// samples and turns it about the normal at random, so that the errors of neighbouring points are
/// independent.
///
/// Threads  immutable after construction; may be shared.
class HemisphereLook {
 public:
  /// @param mesh        kept by reference
  /// @param resolution  as many rays as a disc of so many pixels across has pixels
  HemisphereLook(const MeshRays& mesh, int resolution, std::uint64_t seed);

  /// The rays that met something; neighbours often meet the same side one after another.
  /// @param position  lifted off the surface that it lies on
  /// @param normal    unit
  std::vector<MetSide> from_point(Vec3 position, Vec3 normal) const;

 private:
  static constexpr std::uint32_t kPatterns = 8;

  std::vector<Vec3> directions_at(Vec3 position, Vec3 normal) const;

  const MeshRays& mesh_;
  std::uint64_t seed_;
  std::array<std::vector<Vec3>, kPatterns> pattern_;
};

/// Form factors of the sides met.
FormFactorRow row_of(const std::vector<MetSide>& met);

}  // namespace tenku
