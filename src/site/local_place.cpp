#include "site/local_place.h"

#include <GeographicLib/Geodesic.hpp>
#include <cmath>

namespace tenku {

Location place_of(const Location& origin, Vec3 local) {
  double latitude = 0.0, longitude = 0.0;
  GeographicLib::Geodesic::WGS84().Direct(
      origin.latitude.in_degrees(), origin.longitude.in_degrees(), azimuth_of(local).in_degrees(),
      std::hypot(local.x, local.y), latitude, longitude);
  return {Angle::degrees(latitude), Angle::degrees(longitude), origin.elevation_m + local.z};
}

}  // namespace tenku
