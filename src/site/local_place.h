/// From local metres back to latitude and longitude.
#pragma once

#include "core/vec3.h"
#include "site/location.h"

namespace tenku {

/// The place `local` metres east and north of `origin`, along the geodesic; heights add up.
///
/// Source   C. F. F. Karney, "Algorithms for geodesics", Journal of Geodesy 87, 2013
///          (GeographicLib).
/// Error    that of the local frame: nanometres about the origin, and what a plane is off the
///          ellipsoid elsewhere (`file_frame.h` has it for frames of map grids).
/// Cost     a microsecond.
Location place_of(const Location& origin, Vec3 local);

}  // namespace tenku
