/// Sizes of elements from an error that is allowed, so that no size need be guessed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/light_on_mesh.h"
#include "radiosity/sizes_by_change.h"

namespace tenku {

/// What linear interpolation between corners misses on a side.
struct InterpolationError {
  double lux = 0.0;     ///< root mean square over the side
  double size_m = 0.0;  ///< of the element: mean length of its edges
};

/// From two signs of it, each local to a side and its neighbours. A parabola in an equilateral
/// triangle has seven tenths of its error by either:
/// - 0.12 of the size times how much the slope of the light that is drawn changes at the edges of
///   the side. Edges along lines at which light is known to bend do not count: elements there are
///   no better for being smaller.
/// - 0.7 of how far the light straight from sun, sky and lamps is off in the middle of the side.
///   It finds shadows that no corner lies in, and tells in which element an edge of one lies.
/// What noise explains is taken off.
///
/// @param is_bent  [element], bit k: its edge from corner k on lies on such a line; or none at all
/// Shape    [element side]; nothing where no light comes.
std::vector<InterpolationError> interpolation_error(const LightOnMesh& light,
                                                    std::span<const std::uint8_t> is_bent = {});

/// Root mean square over all lit sides, lux.
double interpolation_rms(const LightOnMesh& light, const std::vector<InterpolationError>& error);

/// What is asked of the sizes. Lengths in metres.
struct ErrorSizes {
  double allowed_lux = 0.0;      ///< root mean square over all lit sides
  std::size_t elements_max = 0;  ///< not to be passed, as far as can be foreseen; 0: any number
  SizeRange range{0.0, 0.0};
};

/// Sizes with which every element has an equal share of the squared error: of all meshes of so many
/// elements that with the least error. With s the present size and e the error an element of size h
/// has the share (e (h / s)^2 h)^2, as where light is smooth. At a jump it falls less: there the
/// next round asks for smaller ones again.
/// Beside lines that edges follow elements stay small enough to follow them again.
/// @param is_bent  as above
/// @return  [element], metres; of the two faces the smaller
std::vector<double> sizes_by_error(const LightOnMesh& light,
                                   const std::vector<InterpolationError>& error,
                                   const ErrorSizes& asked,
                                   std::span<const std::uint8_t> is_bent = {});

}  // namespace tenku
