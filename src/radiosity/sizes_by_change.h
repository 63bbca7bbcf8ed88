/// Sizes of elements from how fast light changes, as the source has them.
#pragma once

#include <span>
#include <vector>

#include "radiosity/light_on_mesh.h"

namespace tenku {

/// dI of each point: the mean over its neighbours of the difference in illuminance by the distance.
/// Nothing where no light comes.
///
/// Source   T. Itoh, A. Yamada, K. Shimada, M. Aono, R. Ohbuchi, "Adaptive meshing for radiosity
/// using
///          bubble mesh method", eq. 1.
/// @return  [point], lux a metre
std::vector<double> change_per_metre(const LightOnMesh& light);

/// The two sizes that a user gives.
struct SizeRange {
  double least_m, most_m;
};

/// f(dI) of each vertex: the linear function that is `most_m` at the least dI of all points and
/// `least_m` at the greatest; of the two faces the smaller size. Where all dI are equal, and where
/// no light comes, `most_m`.
///
/// Source   as above, eqs. 2 to 7, where size_min is the size at the least dI: here `most_m`.
/// @return  [vertex], metres
std::vector<double> sizes_by_change(const LightOnMesh& light, SizeRange range);

}  // namespace tenku
