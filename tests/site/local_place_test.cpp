// From local metres to latitude and longitude.
#include "site/local_place.h"

#include <gtest/gtest.h>

namespace tenku {
namespace {

TEST(LocalPlace, ADegreeOfTheEllipsoidIsADegree) {
  // WGS 84: a degree of the equator is 6378137 m pi / 180, the first of a meridian 110574.389 m.
  const Location origin{Angle::degrees(0.0), Angle::degrees(10.0), 7.0};
  const Location east = place_of(origin, {6378137.0 * kPi / 180.0, 0.0, 5.0});
  EXPECT_NEAR(east.longitude.in_degrees(), 11.0, 1e-9);
  EXPECT_NEAR(east.latitude.in_degrees(), 0.0, 1e-9);
  EXPECT_EQ(east.elevation_m, 12.0);
  const Location south = place_of(origin, {0.0, -110574.389, 0.0});
  EXPECT_NEAR(south.latitude.in_degrees(), -1.0, 1e-8);
  EXPECT_NEAR(south.longitude.in_degrees(), 10.0, 1e-9);
}

}  // namespace
}  // namespace tenku
