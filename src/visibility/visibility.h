/// Who sees what: the one interface through which light asks the geometry.
#pragma once

#include <span>
#include <string_view>

#include "core/vec3.h"

namespace tenku {

/// An engine that tells how much of the light from a far direction reaches a point.
///
/// Frame    local east, north, up; directions are unit vectors from the point to the light.
/// Threads  immutable after construction; may be shared.
class Visibility {
 public:
  virtual ~Visibility() = default;

  /// The name in `--engine`.
  virtual std::string_view name() const = 0;

  /// Transmitted fraction, 0 to 1, for each pair of a point and a direction.
  /// Shape    all three [pair].
  virtual void transmission(std::span<const Vec3> origin, std::span<const Vec3> direction,
                            std::span<float> result) const = 0;

  /// Transmitted fraction, 0 to 1, from one direction to many points: what engines that prepare a
  /// direction do at once. Nothing comes from behind the surface of a point.
  /// @param normal  unit, of the surface that each point lies on; may be empty
  /// Shape    `point`, `result` and, unless empty, `normal` [point].
  virtual void transmission_from(Vec3 direction, std::span<const Vec3> point,
                                 std::span<const Vec3> normal, std::span<float> result) const;
};

}  // namespace tenku
