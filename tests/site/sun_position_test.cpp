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
  WorstError direction("sun_direction_deg"), refracted("refraction_deg"), eot("equation_of_time_min"),
      distance("distance_au"), ra("right_ascension_deg"), dec("declination_deg");
  for (std::size_t i = 0; i < t.size(); ++i) {
    const Sun sun = sun_at(place(t.number(i, "lat_deg"), t.number(i, "lon_deg"), t.number(i, "elev_m")),
                           parse_time(t.text(i, "ut1") + "Z").instant, options_of(t, i));
    const std::string& id = t.text(i, "id");
    const Vec3 expected{t.number(i, "east"), t.number(i, "north"), t.number(i, "up")};
    direction.add(angle_between(sun.direction, expected).in_degrees(), id);
    refracted.add((sun.apparent_altitude - sun.altitude).in_degrees() -
                      t.number(i, "refraction_spa_deg"), id);
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

}  // namespace
}  // namespace tenku
