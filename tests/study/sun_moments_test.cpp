// The days and instants of reflected sunlight.
#include "study/sun_moments.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace tenku {
namespace {

const Location kGreenwich{Angle::degrees(51.48), Angle::degrees(0.0), 0.0};

TEST(SunMoments, TurningDaysAreThoseOfTheAlmanac) {
  // US Naval Observatory, in UTC: 20 March 14:46, 21 June 08:25, 23 September 00:05 and
  // 21 December 20:50 of 2026.
  const auto days = turning_days(parse_time("2026-05-01T12:00Z"), kGreenwich);
  ASSERT_EQ(days.size(), 4U);
  EXPECT_EQ(iso_utc(days[0].noon.instant), "2026-03-20T12:00:00Z");
  EXPECT_EQ(iso_utc(days[1].noon.instant), "2026-06-21T12:00:00Z");
  EXPECT_EQ(iso_utc(days[2].noon.instant), "2026-09-23T12:00:00Z");
  EXPECT_EQ(iso_utc(days[3].noon.instant), "2026-12-21T12:00:00Z");
}

TEST(SunMoments, AYearEndsOnTheClockNotInUtc) {
  const auto days = turning_days(parse_time("2026-12-31T22:00-08:00"), kGreenwich);
  EXPECT_EQ(iso_local(days[1].noon).substr(0, 10), "2026-06-21");
}

TEST(SunMoments, ADayHasEachInstantOnceAndOneAtNoon) {
  for (const double step : {5.0, 7.0, 60.0, 720.0}) {
    const auto times = instants_of_day(parse_time("2026-06-21T09:00+02:00"), step);
    int noons = 0;
    for (const CivilTime& time : times) {
      EXPECT_EQ(iso_local(time).substr(0, 10), "2026-06-21");
      noons += iso_local(time).substr(11, 8) == "12:00:00" ? 1 : 0;
    }
    EXPECT_EQ(noons, 1);
    for (std::size_t k = 1; k < times.size(); ++k) {
      EXPECT_NEAR(seconds_between(times[k - 1].instant, times[k].instant), 60.0 * step, 1e-3);
    }
  }
  EXPECT_EQ(instants_of_day(parse_time("2026-06-21T09:00+02:00"), 5.0).size(), 288U);
  EXPECT_THROW(instants_of_day(parse_time("2026-06-21T09:00Z"), 0.0), InputError);
}

}  // namespace
}  // namespace tenku
