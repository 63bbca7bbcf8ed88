/// Where on Earth the origin of the scene is.
#pragma once

#include "core/units.h"

namespace tenku {

/// Geodetic position on the WGS 84 ellipsoid.
struct Location {
  Angle latitude;            ///< north positive, -90 to 90 degrees
  Angle longitude;           ///< east positive
  double elevation_m = 0.0;  ///< above the ellipsoid
};

}  // namespace tenku
