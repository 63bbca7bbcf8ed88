/// Sizes of elements from an error that is allowed, so that no size need be guessed.
#pragma once

#include <cstddef>
#include <vector>

#include "radiosity/light_on_mesh.h"
#include "radiosity/sizes_by_change.h"

namespace tenku {

/// What linear interpolation between corners misses about a point.
struct InterpolationError {
  double lux = 0.0;     ///< root mean square over elements there, at their present size
  double order = 2.0;   ///< falls as the size to this power: 2 where light is smooth, 0 at a jump
  double size_m = 0.0;  ///< present size: mean length of the edges
};

/// From a parabola fitted to the light about each point, two edges far: a tenth of size^2 times the
/// root mean square of its second derivatives, which is what it leaves out in triangles of that
/// size; and half of how far the values are from the parabola beyond their noise, for a jump
/// lies within one element but shows in the fits about two on either side. The former falls with
/// the square of the size, the latter does not fall at a jump: the order goes from 2 to 0 as it
/// outweighs the former.
///
/// Shape    [point]; nothing where no light comes.
/// Cost     2 us a point
std::vector<InterpolationError> interpolation_error(const LightOnMesh& light);

/// Root mean square over all lit sides, lux.
double interpolation_rms(const LightOnMesh& light, const std::vector<InterpolationError>& error);

/// What is asked of the sizes. Lengths in metres.
struct ErrorSizes {
  double allowed_lux = 0.0;      ///< root mean square over all lit sides
  std::size_t elements_max = 0;  ///< not to be passed, as far as can be foreseen; 0: any number
  SizeRange range{0.0, 0.0};
};

/// Sizes with which every element has an equal share of the squared error: of all meshes of so many
/// elements that with the least error. With s the present size, e the error and p its order, an
/// element of size h has the share (e (h / s)^p h)^2. The order is taken as 1 at least: what looks
/// like a jump is a penumbra more often, and elements by the dozen about it would be lost.
/// @return  [vertex], metres; of the two faces the smaller
std::vector<double> sizes_by_error(const LightOnMesh& light,
                                   const std::vector<InterpolationError>& error,
                                   const ErrorSizes& asked);

}  // namespace tenku
