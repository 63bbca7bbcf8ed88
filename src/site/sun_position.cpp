#include "site/sun_position.h"

#include <erfa.h>
#include <erfam.h>
#include <fmt/format.h>

#include <GeographicLib/Geocentric.hpp>
#include <array>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "site/nrel_sun.h"

namespace tenku {
namespace {

// Angular radius of the sun at one astronomical unit: IAU (1976), 959.63 arc seconds.
constexpr double kRadiusAtOneAu_deg = 959.63 / 3600.0;
constexpr double kSemidiameter_deg = 0.26667;      // Reda and Andreas, section 3.11
constexpr double kHorizonRefraction_deg = 0.5667;  // likewise

struct Site {
  Vec3 position_m;  // from the centre of the Earth, in the Earth-fixed frame
  Vec3 east, north, up;
};

Site earth_fixed(const Location& location) {
  const auto& wgs84 = GeographicLib::Geocentric::WGS84();
  Site site;
  std::vector<double> m(9);
  wgs84.Forward(location.latitude.in_degrees(), location.longitude.in_degrees(),
                location.elevation_m, site.position_m.x, site.position_m.y, site.position_m.z, m);
  site.east = {m[0], m[3], m[6]};
  site.north = {m[1], m[4], m[7]};
  site.up = {m[2], m[5], m[8]};
  return site;
}

/// Rotations between the celestial frame (GCRS), the true equator of date and the Earth.
struct Orientation {
  double to_date[3][3];   // celestial -> true equator and equinox of date
  double to_earth[3][3];  // celestial -> Earth-fixed
  double sidereal_rad;    // apparent, at Greenwich
};

Orientation orientation_at(const TimeScales& t) {
  Orientation o{};
  double no_polar_motion[3][3];
  eraIr(no_polar_motion);
  eraPnm06a(t.tt.day, t.tt.fraction, o.to_date);
  o.sidereal_rad = eraGst06(t.ut1.day, t.ut1.fraction, t.tt.day, t.tt.fraction, o.to_date);
  eraC2teqx(o.to_date, o.sidereal_rad, no_polar_motion, o.to_earth);
  return o;
}

Vec3 rotated(const double m[3][3], Vec3 v) {
  return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
          m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
          m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}

Vec3 rotated_back(const double m[3][3], Vec3 v) {
  return {m[0][0] * v.x + m[1][0] * v.y + m[2][0] * v.z,
          m[0][1] * v.x + m[1][1] * v.y + m[2][1] * v.z,
          m[0][2] * v.x + m[1][2] * v.y + m[2][2] * v.z};
}

Vec3 vec(const double v[3]) { return {v[0], v[1], v[2]}; }

/// Position (au) and velocity (au/day) from the solar system's barycentre.
struct Motion {
  Vec3 position, velocity;
};

struct Ephemeris {
  Motion earth, sun;  // barycentric
};

Ephemeris ephemeris_at(JulianDate tt) {
  double from_sun[2][3], from_barycentre[2][3];
  eraEpv00(tt.day, tt.fraction, from_sun, from_barycentre);  // its status only warns of the year
  const Motion earth{vec(from_barycentre[0]), vec(from_barycentre[1])};
  return {earth, {earth.position - vec(from_sun[0]), earth.velocity - vec(from_sun[1])}};
}

/// Vector (au) to where the sun was when its light left, from an observer who stands still.
/// In eight minutes the sun moves 7 km about the barycentre, on what is then a straight line.
Vec3 to_sun(const Motion& observer, const Motion& sun) {
  constexpr double kLightTime_day_au = ERFA_AULT / ERFA_DAYSEC;
  const Vec3 path = sun.position - observer.position;
  return path - kLightTime_day_au * length(path) * sun.velocity;
}

/// The same for one who moves.
Vec3 aberrated(Vec3 path, const Motion& observer) {
  constexpr double kLight_au_day = ERFA_DAYSEC / ERFA_AULT;
  const Vec3 natural = normalized(path);
  const Vec3 v = (1.0 / kLight_au_day) * observer.velocity;
  double from[3] = {natural.x, natural.y, natural.z}, speed[3] = {v.x, v.y, v.z}, to[3];
  eraAb(from, speed, length(observer.position), std::sqrt(1.0 - dot(v, v)), to);
  return normalized(vec(to));
}

Motion at_site(const Motion& earth, const Site& site, const Orientation& orientation) {
  constexpr double kTurn_rad_day = 2.0 * kPi * 1.00273781191135448;  // Earth rotation angle's rate
  const Vec3 place = rotated_back(orientation.to_earth, (1.0 / ERFA_DAU) * site.position_m);
  const Vec3 axis = rotated_back(orientation.to_earth, kZenith);
  return {earth.position + place, earth.velocity + kTurn_rad_day * cross(axis, place)};
}

double wrapped_degrees(double degrees) { return std::remainder(degrees, 360.0); }

void set_geocentric(Sun& sun, const Ephemeris& bodies, const TimeScales& t, const Orientation& o) {
  const Vec3 path = to_sun(bodies.earth, bodies.sun);
  const Vec3 apparent = rotated(o.to_date, aberrated(path, bodies.earth));
  const double right_ascension = std::atan2(apparent.y, apparent.x);
  sun.right_ascension =
      Angle::radians(right_ascension < 0.0 ? right_ascension + 2.0 * kPi : right_ascension);
  sun.declination = altitude_of(apparent);
  sun.distance_au = length(path);
  const double greenwich_hour_angle =
      Angle::radians(o.sidereal_rad).in_degrees() - sun.right_ascension.in_degrees();
  const double day_fraction = std::remainder(t.ut1.day + 0.5, 1.0) + t.ut1.fraction;
  sun.equation_of_time_min =
      4.0 * wrapped_degrees(greenwich_hour_angle + 180.0 - 360.0 * day_fraction);
  sun.hour_angle = Angle::degrees(greenwich_hour_angle);  // the site's longitude is added later
}

}  // namespace

Air standard_air(double elevation_m) {
  const double h = std::clamp(elevation_m, -1000.0, 11000.0);
  const double kelvin = 288.15 - 0.0065 * h;
  return {1013.25 * std::pow(kelvin / 288.15, 5.25588), kelvin - 273.15};
}

void check_location(const Location& site) {
  const double latitude = site.latitude.in_degrees(), longitude = site.longitude.in_degrees();
  if (!(std::abs(latitude) <= 90.0 + 1e-9)) {
    throw InputError(fmt::format("latitude {} degrees is not in -90..90", latitude));
  }
  if (!(longitude >= -180.0 - 1e-9 && longitude <= 360.0 + 1e-9)) {
    throw InputError(fmt::format("longitude {} degrees is not in -180..360", longitude));
  }
  if (!(site.elevation_m >= -1000.0 && site.elevation_m <= 100000.0)) {
    throw InputError(fmt::format("elevation {} m is not in -1000..100000", site.elevation_m));
  }
}

void check_air(const Air& air) {
  if (!(air.pressure_hpa >= 0.0 && air.pressure_hpa <= 5000.0)) {
    throw InputError(fmt::format("air pressure {} hPa is not in 0..5000", air.pressure_hpa));
  }
  if (!(air.temperature_c > -273.0 && air.temperature_c <= 6000.0)) {
    throw InputError(fmt::format("air temperature {} C is not above -273", air.temperature_c));
  }
}

Angle refraction(Angle altitude, const Air& air) {
  const double e = altitude.in_degrees();
  if (e < -(kSemidiameter_deg + kHorizonRefraction_deg) || e >= 90.0) return {};
  const double arc_minutes = 1.02 / std::tan(Angle::degrees(e + 10.3 / (e + 5.11)).in_radians());
  return Angle::degrees(air.pressure_hpa / 1010.0 * 283.0 / (273.0 + air.temperature_c) *
                        arc_minutes / 60.0);
}

Sun sun_at(const Location& location, Instant instant, const SunOptions& options) {
  if (options.algorithm == SunAlgorithm::Nrel) return sun_at_by_nrel(location, instant, options);
  check_location(location);
  const Air air = options.air.value_or(standard_air(location.elevation_m));
  check_air(air);
  const TimeScales t = time_scales(instant, options.rotation);
  const Orientation orientation = orientation_at(t);
  const Site site = earth_fixed(location);
  const Ephemeris bodies = ephemeris_at(t.tt);
  const Motion observer = at_site(bodies.earth, site, orientation);

  Sun sun;
  set_geocentric(sun, bodies, t, orientation);
  sun.hour_angle = Angle::degrees(
      wrapped_degrees(sun.hour_angle.in_degrees() + location.longitude.in_degrees()));
  const Vec3 path = to_sun(observer, bodies.sun);
  const Vec3 d = rotated(orientation.to_earth, aberrated(path, observer));
  sun.direction = normalized({dot(d, site.east), dot(d, site.north), dot(d, site.up)});
  sun.altitude = altitude_of(sun.direction);
  sun.azimuth = azimuth_of(sun.direction);
  sun.apparent_altitude =
      options.refraction ? sun.altitude + refraction(sun.altitude, air) : sun.altitude;
  sun.apparent_direction = direction_from(sun.azimuth, sun.apparent_altitude);
  sun.angular_radius = Angle::degrees(kRadiusAtOneAu_deg / length(path));
  return sun;
}

}  // namespace tenku
