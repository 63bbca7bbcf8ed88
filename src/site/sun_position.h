/// Place and time to the sun.
#pragma once

#include <optional>

#include "core/units.h"
#include "core/vec3.h"
#include "site/civil_time.h"
#include "site/location.h"
#include "site/time_scales.h"

namespace tenku {

/// The air that bends the sun's light at the site.
struct Air {
  double pressure_hpa = 1013.25;
  double temperature_c = 15.0;
};

/// Air of the standard atmosphere at a height.
///
/// Source   ISO 2533:1975, troposphere: 6.5 K/km from 15 degrees C and 1013.25 hPa at sea level.
/// Valid    to 11 km; the height is clamped to -1 .. 11 km.
Air standard_air(double elevation_m);

/// How the position of the sun is found.
enum class SunAlgorithm {
  Precise,  ///< the one described at `sun_at`
  Nrel,     ///< the NREL solar position algorithm, `nrel_sun.h`
};

/// Choices in the position of the sun; each has a built-in answer.
struct SunOptions {
  bool refraction = true;
  std::optional<Air> air;  ///< default: `standard_air` of the height
  EarthRotation rotation;
  SunAlgorithm algorithm = SunAlgorithm::Precise;
};

/// The sun as seen from a site.
///
/// Frame    directions and angles: x east, y north, z up by the normal of the ellipsoid;
///          unrefracted unless named apparent.
struct Sun {
  Vec3 direction;                     ///< unit, to the centre, without refraction
  Vec3 apparent_direction;            ///< unit, as the eye sees it
  Angle altitude;                     ///< without refraction
  Angle apparent_altitude;            ///< with it
  Angle azimuth;                      ///< clockwise from true north
  Angle right_ascension;              ///< apparent, geocentric, true equator and equinox of date
  Angle declination;                  ///< likewise
  double distance_au = 1.0;           ///< from the centre of the Earth
  Angle angular_radius;               ///< as seen from the site
  double equation_of_time_min = 0.0;  ///< apparent less mean solar time
  Angle hour_angle;                   ///< apparent, geocentric, west positive, -180 to 180 degrees
};

/// Position of the sun at an instant.
///
/// Earth ephemeris and precession-nutation (IAU 2006/2000A), light time, annual and diurnal
/// aberration and topocentric parallax; the site on the WGS 84 ellipsoid, polar motion neglected.
/// Source   IAU SOFA / ERFA 2.0; P. Bretagnon's VSOP2000 shortened (`epv00`).
/// Error    without refraction 5e-6 degrees for 1950-2050 where the Earth's rotation is known
///          (docs/validation.md); the ephemeris is fitted to 1900-2100 and degrades slowly outside.
/// Cost     0.3 ms.
/// @throws InputError if the location is out of range, or air or rotation are no numbers
Sun sun_at(const Location& site, Instant instant, const SunOptions& options = {});

/// Rise of the sun's altitude by refraction.
///
/// Source   I. Reda and A. Andreas, NREL/TP-560-34302 (2008), equation 42, after Meeus 1998; zero
/// for a sun whose
///          disc is wholly below the horizon, as there.
/// Valid    1e-4 degrees against ray tracing above 15 degrees, some 0.01 degrees at the horizon.
/// @param altitude  without refraction
Angle refraction(Angle altitude, const Air& air);

/// @throws InputError if pressure or temperature are out of range or no numbers
void check_air(const Air& air);

/// Refuses a latitude, longitude or elevation out of range or not finite.
/// Longitudes from -180 to 360 degrees are understood; elevations from -1000 to 100000 m.
/// @throws InputError
void check_location(const Location& site);

}  // namespace tenku
