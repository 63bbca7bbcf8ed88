#include "site/sun_position.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "support/measured.h"
#include "support/reference_table.h"

namespace tenku {
namespace {

using testing_support::ReferenceTable;
using testing_support::WorstError;

Location place(double latitude_deg, double longitude_deg, double elevation_m) {
  return {Angle::degrees(latitude_deg), Angle::degrees(longitude_deg), elevation_m};
}

// Times in UT1: delta T as given, UT1 - UTC zero.
SunOptions options_of(const ReferenceTable& t, std::size_t i) {
  SunOptions options;
  options.rotation = {t.number(i, "delta_t_s"), 0.0};
  options.air = Air{t.number(i, "pressure_hPa"), t.number(i, "temp_C")};
  return options;
}

// The reference states 5e-6 degrees for itself; the goal of methods.md is 0.0003.
TEST(SunPosition, AgreesWithTheReferenceEverywhere) {
  const ReferenceTable t(TENKU_TEST_REFERENCE "/sun/positions.csv");
  ASSERT_EQ(t.size(), 1200u);
  WorstError direction("sun_direction_deg"), refracted("refraction_deg"),
      eot("equation_of_time_min"), distance("distance_au"), ra("right_ascension_deg"),
      dec("declination_deg");
  for (std::size_t i = 0; i < t.size(); ++i) {
    const Sun sun =
        sun_at(place(t.number(i, "lat_deg"), t.number(i, "lon_deg"), t.number(i, "elev_m")),
               parse_time(t.text(i, "ut1") + "Z").instant, options_of(t, i));
    const std::string& id = t.text(i, "id");
    const Vec3 expected{t.number(i, "east"), t.number(i, "north"), t.number(i, "up")};
    direction.add(angle_between(sun.direction, expected).in_degrees(), id);
    refracted.add(
        (sun.apparent_altitude - sun.altitude).in_degrees() - t.number(i, "refraction_spa_deg"),
        id);
    eot.add(sun.equation_of_time_min - t.number(i, "eot_min"), id);
    distance.add(sun.distance_au - t.number(i, "geo_dist_au"), id);
    ra.add(std::remainder(sun.right_ascension.in_degrees() - t.number(i, "geo_ra_deg"), 360.0), id);
    dec.add(sun.declination.in_degrees() - t.number(i, "geo_dec_deg"), id);
  }
  EXPECT_LT(direction.worst(), 2e-5);
  EXPECT_LT(refracted.worst(), 1e-4);
  EXPECT_LT(eot.worst(), 1e-4);
  EXPECT_LT(distance.worst(), 1e-7);
  EXPECT_LT(ra.worst(), 2e-5);
  EXPECT_LT(dec.worst(), 2e-5);
}

// NREL/TP-560-34302, appendix A.5. The report claims 0.0003 degrees for its own algorithm, and this
// one, being closer to the sun, differs from its printed digits by up to half of that.
TEST(SunPosition, AgreesWithTheNrelExampleWithinItsOwnUncertainty) {
  SunOptions options;
  options.air = Air{820.0, 11.0};
  options.rotation = {67.0, 0.0};
  const Sun sun = sun_at(place(39.742476, -105.1786, 1830.14),
                         parse_time("2003-10-17T12:30:30-07:00").instant, options);
  const Vec3 printed = direction_from(Angle::degrees(194.340241), Angle::degrees(39.872046));
  EXPECT_LT(angle_between(sun.direction, printed).in_degrees(), 1.2e-4);
  EXPECT_NEAR(90.0 - sun.apparent_altitude.in_degrees(), 50.111622, 5e-5);
  EXPECT_NEAR((sun.apparent_altitude - sun.altitude).in_degrees(), 0.016332, 5e-7);
  EXPECT_NEAR(sun.right_ascension.in_degrees(), 202.22741, 5e-5);
  EXPECT_NEAR(sun.declination.in_degrees(), -9.31434, 1.5e-5);
  EXPECT_NEAR(sun.distance_au, 0.9965422974, 2e-7);
  EXPECT_NEAR(sun.equation_of_time_min, 14.64, 5e-3);
}

// JPL Horizons, quoted in skyfield's tests: apparent ecliptic longitude of date.
TEST(SunPosition, AgreesWithHorizons) {
  const Sun sun = sun_at(place(0, 0, 0), parse_time("2005-10-01T07:00Z").instant);
  const double obliquity = 23.4385 * kPi / 180.0;  // true, of date, to 0.0005 degrees
  const double ra = sun.right_ascension.in_radians(), dec = sun.declination.in_radians();
  const double longitude = std::atan2(
      std::sin(ra) * std::cos(obliquity) + std::tan(dec) * std::sin(obliquity), std::cos(ra));
  EXPECT_NEAR(longitude * 180.0 / kPi + 360.0, 188.2011122, 1e-4);
}

TEST(SunPosition, RefractionCanBeLeftOutAndFollowsTheAir) {
  const Location site = place(43.06, 141.35, 20.0);
  const Instant t = parse_time("2026-06-21T05:00+09:00").instant;
  SunOptions none;
  none.refraction = false;
  EXPECT_EQ(sun_at(site, t, none).apparent_altitude, sun_at(site, t, none).altitude);
  EXPECT_GT(sun_at(site, t).apparent_altitude, sun_at(site, t).altitude);
  // Meeus, Astronomical Algorithms, chapter 16: 28.754' at a true altitude of 33'20'' (0.5541
  // degrees) and 1010 hPa, 10 C: his formula is printed to 0.07'.
  EXPECT_NEAR(60.0 * refraction(Angle::degrees(0.5541), {1010.0, 10.0}).in_degrees(), 24.618, 0.07);
}

// U.S. Standard Atmosphere 1976, table I.
TEST(SunPosition, StandardAirIsTheTabulatedOne) {
  EXPECT_NEAR(standard_air(1000.0).pressure_hpa, 898.76, 0.5);
  EXPECT_NEAR(standard_air(3000.0).pressure_hpa, 701.21, 0.5);
  EXPECT_NEAR(standard_air(3000.0).temperature_c, -4.5, 0.05);
}

// The Astronomical Almanac: semidiameter 16' 15.9'' in early January, 15' 43.8'' in early July.
TEST(SunPosition, AngularRadiusFollowsTheDistance) {
  const Location site = place(0.0, 0.0, 0.0);
  const auto radius = [&](const char* time) {
    return 3600.0 * sun_at(site, parse_time(time).instant).angular_radius.in_degrees();
  };
  EXPECT_NEAR(radius("2026-01-03T12:00Z"), 975.9, 0.2);
  EXPECT_NEAR(radius("2026-07-06T12:00Z"), 943.8, 0.2);
}

TEST(SunPosition, WrongPlacesAreRefused) {
  const Instant t = parse_time("2026-06-21T05:00Z").instant;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(sun_at(place(91, 0, 0), t), InputError);
  EXPECT_THROW(sun_at(place(nan, 0, 0), t), InputError);
  EXPECT_THROW(sun_at(place(0, 361, 0), t), InputError);
  EXPECT_THROW(sun_at(place(0, nan, 0), t), InputError);
  EXPECT_THROW(sun_at(place(0, 0, nan), t), InputError);
  SunOptions air;
  air.air = Air{nan, 10.0};
  EXPECT_THROW(sun_at(place(0, 0, 0), t, air), InputError);
  SunOptions rotation;
  rotation.rotation.dut1_s = nan;
  EXPECT_THROW(sun_at(place(0, 0, 0), t, rotation), InputError);
}

}  // namespace
}  // namespace tenku
