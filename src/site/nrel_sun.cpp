#include "site/nrel_sun.h"

#include <cmath>
#include <span>

#include "site/nrel_tables.h"

namespace tenku {
namespace {

constexpr double kDegree = kPi / 180.0;
constexpr double kJ2000 = 2451545.0;
constexpr double kEarthRadius_m = 6378140.0;  // equatorial, as in the report
constexpr double kPolarRatio = 0.99664719;    // polar to equatorial, likewise
constexpr double kRadiusAtOneAu_deg = 959.63 / 3600.0;

double turned_to_positive(double degrees) {
  const double r = std::fmod(degrees, 360.0);
  return r < 0.0 ? r + 360.0 : r;
}

double series(std::span<const NrelTerm> terms, double jme) {
  double sum = 0.0;
  for (const NrelTerm& t : terms) sum += t.a * std::cos(t.b + t.c * jme);
  return sum;
}

// Equations 9-12.
double longitude_rad(double t) {
  const double sums[] = {series(kNrelL0, t), series(kNrelL1, t), series(kNrelL2, t),
                         series(kNrelL3, t), series(kNrelL4, t), series(kNrelL5, t)};
  double value = 0.0;
  for (int i = 5; i >= 0; --i) value = value * t + sums[i];
  return value / 1e8;
}

double latitude_rad(double t) { return (series(kNrelB0, t) + series(kNrelB1, t) * t) / 1e8; }

double distance_au(double t) {
  const double sums[] = {series(kNrelR0, t), series(kNrelR1, t), series(kNrelR2, t),
                         series(kNrelR3, t), series(kNrelR4, t)};
  double value = 0.0;
  for (int i = 4; i >= 0; --i) value = value * t + sums[i];
  return value / 1e8;
}

struct Nutation {
  double longitude_deg, obliquity_deg;
};

// Equations 15-22.
Nutation nutation(double t) {
  const double x[] = {297.85036 + t * (445267.111480 + t * (-0.0019142 + t / 189474.0)),
                      357.52772 + t * (35999.050340 + t * (-0.0001603 - t / 300000.0)),
                      134.96298 + t * (477198.867398 + t * (0.0086972 + t / 56250.0)),
                      93.27191 + t * (483202.017538 + t * (-0.0036825 + t / 327270.0)),
                      125.04452 + t * (-1934.136261 + t * (0.0020708 + t / 450000.0))};
  Nutation n{0.0, 0.0};
  for (const NrelNutationTerm& term : kNrelNutation) {
    double argument = 0.0;
    for (int j = 0; j < 5; ++j) argument += x[j] * term.y[j];
    n.longitude_deg += (term.a + term.b * t) * std::sin(argument * kDegree);
    n.obliquity_deg += (term.c + term.d * t) * std::cos(argument * kDegree);
  }
  return {n.longitude_deg / 36e6, n.obliquity_deg / 36e6};
}

// Equation 24.
double mean_obliquity_deg(double jme) {
  constexpr double kTerms[] = {84381.448, -4680.93, -1.55, 1999.25, -51.38, -249.67,
                               -39.05,    7.12,     27.87, 5.79,    2.45};
  const double u = jme / 10.0;
  double value = 0.0;
  for (int i = 10; i >= 0; --i) value = value * u + kTerms[i];
  return value / 3600.0;
}

/// Geocentric place, degrees.
struct Place {
  double right_ascension, declination, distance, obliquity, nutation;
};

Place geocentric(double jme) {
  const Nutation n = nutation(10.0 * jme);
  const double r = distance_au(jme);
  const double obliquity = mean_obliquity_deg(jme) + n.obliquity_deg;
  const double aberration = -20.4898 / (3600.0 * r);
  const double lambda =
      (longitude_rad(jme) / kDegree + 180.0 + n.longitude_deg + aberration) * kDegree;
  const double beta = -latitude_rad(jme), e = obliquity * kDegree;
  const double alpha =
      std::atan2(std::sin(lambda) * std::cos(e) - std::tan(beta) * std::sin(e), std::cos(lambda));
  const double delta =
      std::asin(std::sin(beta) * std::cos(e) + std::cos(beta) * std::sin(e) * std::sin(lambda));
  return {turned_to_positive(alpha / kDegree), delta / kDegree, r, obliquity, n.longitude_deg};
}

// Equations 28-31; the day and its fraction apart, for their digits.
double sidereal_deg(const JulianDate& ut, const Place& place) {
  const double days = (ut.day - kJ2000) + ut.fraction, t = days / 36525.0;
  const double mean =
      280.46061837 + 360.98564736629 * days + t * t * (0.000387933 - t / 38710000.0);
  return turned_to_positive(mean + place.nutation * std::cos(place.obliquity * kDegree));
}

// Equations 33-41: topocentric direction from geocentric place.
Vec3 topocentric(const Place& place, double hour_angle, const Location& site) {
  const double phi = site.latitude.in_radians(), h = hour_angle * kDegree;
  const double xi = 8.794 / (3600.0 * place.distance) * kDegree, d = place.declination * kDegree;
  const double u = std::atan(kPolarRatio * std::tan(phi));
  const double x = std::cos(u) + site.elevation_m / kEarthRadius_m * std::cos(phi);
  const double y = kPolarRatio * std::sin(u) + site.elevation_m / kEarthRadius_m * std::sin(phi);
  const double denominator = std::cos(d) - x * std::sin(xi) * std::cos(h);
  const double shift = std::atan2(-x * std::sin(xi) * std::sin(h), denominator);
  const double dt = std::atan2((std::sin(d) - y * std::sin(xi)) * std::cos(shift), denominator);
  const double ht = h - shift;
  return {-std::cos(dt) * std::sin(ht),
          std::sin(dt) * std::cos(phi) - std::cos(dt) * std::cos(ht) * std::sin(phi),
          std::sin(phi) * std::sin(dt) + std::cos(phi) * std::cos(dt) * std::cos(ht)};
}

// Equations A1 and A2 of the appendix.
double equation_of_time_min(double jme, const Place& place) {
  const double mean =
      280.4664567 +
      jme * (360007.6982779 +
             jme * (0.03032028 + jme * (1.0 / 49931.0 - jme * (1.0 / 15300.0 + jme / 2000000.0))));
  return 4.0 * std::remainder(mean - 0.0057183 - place.right_ascension +
                                  place.nutation * std::cos(place.obliquity * kDegree),
                              360.0);
}

}  // namespace

Sun sun_at_by_nrel(const Location& site, Instant instant, const SunOptions& options) {
  check_location(site);
  const Air air = options.air.value_or(standard_air(site.elevation_m));
  check_air(air);
  const TimeScales t = time_scales(instant, options.rotation);
  const double jme = ((t.tt.day - kJ2000) + t.tt.fraction) / 365250.0;
  const Place place = geocentric(jme);
  const double hour_angle =
      sidereal_deg(t.ut1, place) + site.longitude.in_degrees() - place.right_ascension;
  Sun sun;
  sun.direction = topocentric(place, hour_angle, site);
  sun.altitude = altitude_of(sun.direction);
  sun.azimuth = azimuth_of(sun.direction);
  sun.apparent_altitude =
      options.refraction ? sun.altitude + refraction(sun.altitude, air) : sun.altitude;
  sun.apparent_direction = direction_from(sun.azimuth, sun.apparent_altitude);
  sun.right_ascension = Angle::degrees(place.right_ascension);
  sun.declination = Angle::degrees(place.declination);
  sun.distance_au = place.distance;
  sun.angular_radius = Angle::degrees(kRadiusAtOneAu_deg / place.distance);
  sun.equation_of_time_min = equation_of_time_min(jme, place);
  sun.hour_angle = Angle::degrees(std::remainder(hour_angle, 360.0));
  return sun;
}

}  // namespace tenku
