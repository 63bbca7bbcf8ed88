/// The elements as a point sees them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec3.h"
#include "form_factors/convex_polygon.h"
#include "form_factors/form_factor.h"

namespace tenku {

/// A number that belongs to a point and its normal, the same whenever they are asked for.
std::uint64_t key_of(Vec3 position, Vec3 normal, std::uint64_t seed);

/// Axes at a point: z along the normal, x and y across it, turned about it by an angle that is
/// random from point to point, so that errors of a pattern of samples differ between points.
struct PointAxes {
  Vec3 x, y, z;

  PointAxes(Vec3 normal, std::uint64_t key);
};

/// A side with some part above the horizon.
struct SeenSide {
  std::uint32_t side;
  /// The inverse of the distance to the plane of the element in the direction d is dot(nearness,
  /// d), for d of length 1: it grows toward the point, and it is linear in d.
  Vec3 nearness;
};

/// What stands above the horizon of a point: sides that the point sees, whatever stands before
/// them. Elements seen edge-on, which cover nothing, are left out.
///
/// Frame  `PointAxes` at the point.
struct PointView {
  PointView(const ElementMesh& mesh, Vec3 position, const PointAxes& axes);

  /// The part of a seen element above the horizon; its corners are not directions but points.
  ConvexPolygon polygon(const ElementMesh& mesh, const SeenSide& seen) const;

  std::vector<Vec3> vertex;  ///< of the mesh, whether seen or not
  std::vector<SeenSide> seen;
};

/// A row of the matrix from what each seen side covers.
/// @param covered  [seen]
/// @param unit     form factor of one unit of `covered`
FormFactorRow row_of(const PointView& view, const std::vector<double>& covered, double unit);

}  // namespace tenku
