/// Where on Earth a scene is, from the name of its coordinate reference system.
#pragma once

#include <optional>
#include <string>

#include "core/units.h"
#include "core/vec3.h"
#include "site/location.h"

namespace tenku {

/// Place of the local origin, and how the grid of the file lies there.
struct Georeference {
  std::string crs;               ///< `EPSG:7415`; empty if only the place is known
  std::string name;              ///< as the registry has it: `Amersfoort / RD New + NAP height`
  Location origin;               ///< of the local origin; elevation is the file's height there
  Angle grid_convergence;        ///< true azimuth of grid north, clockwise
  double point_scale = 1.0;      ///< grid length / true length on the ellipsoid, at the origin
  double metres_per_unit = 1.0;  ///< nominal length of a unit of the grid
};

/// What PROJ calls the map of a scene in degrees (FileFrame::geographic): metres about a place.
std::string map_about(const Location& place);

/// A coordinate reference system, ready to be asked about points.
///
/// Source   PROJ with the EPSG registry; azimuths and lengths by C. Karney's geodesics
///          (GeographicLib).
/// Frame    points of a projected CRS are easting, northing, height whatever order the registry
///          has; heights are taken from the file unchanged.
/// Error    convergence 1e-6 degrees, scale 1e-8, against the defining projections; the place
///          is as good as the datum transformation that PROJ finds without grids (about 1 m).
struct Crs {
  std::string id;  ///< `EPSG:7415`
  std::string name;
  bool geographic = false;
  double metres_per_unit = 1.0;
  /// Bounds of use, degrees, for telling the order of latitude and longitude.
  double west = -180.0, south = -90.0, east = 180.0, north = 90.0;

  /// @param text  `EPSG:7415`, `urn:ogc:def:crs:EPSG::7415`, a compound URN,
  ///              `https://www.opengis.net/def/crs/EPSG/0/7415`, or a bare number
  /// @throws InputError if it is not a CRS that PROJ knows, or is neither projected nor geographic
  static Crs parse(const std::string& text);

  /// For a projected CRS: what holds at the point (easting, northing).
  /// @throws InputError if the point is outside what the projection can invert
  Georeference at(Vec3 grid_point) const;
};

}  // namespace tenku
