#include "site/civil_time.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "site/time_scales.h"
#include "support/measured.h"
#include "support/reference_table.h"

namespace tenku {
namespace {

std::string message_of(const std::string& time, const std::string& zone = "") {
  try {
    parse_time(time, zone);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

double julian_date(const std::string& time) {
  const Instant t = parse_time(time).instant;
  return t.day + t.fraction;
}

TEST(CivilTime, OffsetsAndZonesNameTheSameInstant) {
  const std::string utc = iso_utc(parse_time("2026-06-21T00:00Z").instant);
  EXPECT_EQ(iso_utc(parse_time("2026-06-21T09:00+09:00").instant), utc);
  EXPECT_EQ(iso_utc(parse_time("2026-06-21T09:00", "Asia/Tokyo").instant), utc);
  EXPECT_EQ(iso_utc(parse_time("2026-06-20 20:00:00", "America/New_York").instant), utc);
  EXPECT_EQ(iso_utc(parse_time("2026-06-21T05:45+0545").instant), utc);
}

// NREL/TP-560-34302, table A4.1 (Gregorian rows).
TEST(CivilTime, JulianDatesAreThoseOfTheNrelReport) {
  EXPECT_NEAR(julian_date("2000-01-01T12:00:00Z"), 2451545.0, 1e-9);
  EXPECT_NEAR(julian_date("1999-01-01T00:00:00Z"), 2451179.5, 1e-9);
  EXPECT_NEAR(julian_date("1987-06-19T12:00:00Z"), 2446966.0, 1e-9);
  EXPECT_NEAR(julian_date("1988-01-27T00:00:00Z"), 2447187.5, 1e-9);
  EXPECT_NEAR(julian_date("1900-01-01T00:00:00Z"), 2415020.5, 1e-9);
  EXPECT_NEAR(julian_date("1600-12-31T00:00:00Z"), 2305812.5, 1e-9);
  EXPECT_NEAR(julian_date("2003-10-17T12:30:30-07:00"), 2452930.312847, 5e-7);
}

TEST(CivilTime, GapAndOverlapNameBothReadings) {
  const std::string gap = message_of("2026-03-29T02:30", "Europe/Vienna");
  EXPECT_NE(gap.find("2026-03-29T02:30+01:00"), std::string::npos) << gap;
  EXPECT_NE(gap.find("2026-03-29T02:30+02:00"), std::string::npos) << gap;
  const std::string overlap = message_of("2026-10-25T02:30", "Europe/Vienna");
  EXPECT_NE(overlap.find("2026-10-25T02:30+02:00"), std::string::npos) << overlap;
  EXPECT_NE(overlap.find("2026-10-25T02:30+01:00"), std::string::npos) << overlap;
  EXPECT_EQ(message_of("2026-03-29T03:30", "Europe/Vienna"), "");
}

TEST(CivilTime, WrongTextIsRefused) {
  for (const char* text :
       {"", "today", "2026-06-21", "2026-06-21T09:00", "2026-13-01T00:00Z", "2026-02-29T00:00Z",
        "2026-06-21T24:00Z", "2026-06-21T09:60Z", "2026-06-21T09:00:61Z", "2026-06-21T09:00+99:00",
        "2026-06-21T09:00Zz", "2026-06-21T09:00:00.Z", "26-06-21T09:00Z", "1500-01-01T00:00Z",
        "2026-06-21T09:00:60Z", "2017-06-30T23:59:60Z", "+026-06-21T09:00Z", "nan"}) {
    EXPECT_NE(message_of(text), "") << text;
  }
  EXPECT_NE(message_of("2026-06-21T09:00", "Asia/Tokio").find("Asia/Tokio"), std::string::npos);
  EXPECT_EQ(message_of("2024-02-29T00:00Z"), "");
}

// IERS Bulletin C 52: a leap second at the end of 2016.
TEST(CivilTime, LeapSecondIsATimeAndRunsOn) {
  const Instant leap = parse_time("2016-12-31T23:59:60Z").instant;
  const Instant next = parse_time("2017-01-01T00:00:00Z").instant;
  const TimeScales a = time_scales(leap), b = time_scales(next);
  EXPECT_NEAR((b.tt.day - a.tt.day + b.tt.fraction - a.tt.fraction) * 86400.0, 1.0, 1e-4);
  EXPECT_NEAR((b.ut1.day - a.ut1.day + b.ut1.fraction - a.ut1.fraction) * 86400.0, 1.0, 2e-2);
}

TEST(CivilTime, LocalNoonFollowsTheClockOfItsZone) {
  EXPECT_EQ(iso_local(local_noon(parse_time("2026-03-29T00:30", "Europe/Vienna"))),
            "2026-03-29T12:00:00+02:00");
  EXPECT_EQ(iso_local(local_noon(parse_time("2026-06-21T23:00+09:00"))),
            "2026-06-21T12:00:00+09:00");
}

TEST(CivilTime, DayOfYearCountsLeapDays) {
  EXPECT_EQ(day_of_year(parse_time("2024-12-31T12:00Z").instant), 366);
  EXPECT_EQ(day_of_year(parse_time("2023-03-01T12:00Z").instant), 60);
}

// Naval Observatory to 1972, IERS from 1973: the values of 1 January.
TEST(TimeScales, DeltaTAtNewYearIsTheObservedOne) {
  const testing_support::ReferenceTable t(TENKU_TEST_REFERENCE "/sun/delta_t.csv");
  testing_support::WorstError worst("delta_t_new_year_1950_2026_s");
  ASSERT_EQ(t.size(), 77u);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double new_year = 2451544.5 + 365.25 * (t.number(i, "year") - 2000.0);  // to a day
    worst.add(delta_t_seconds(new_year) - t.number(i, "delta_t_s"), t.text(i, "year"));
  }
  EXPECT_LT(worst.worst(), 0.0051);  // rounded to 0.01 s
}

// This reference has a smooth fit of its own before 1973, and predictions from 2023.
TEST(TimeScales, DeltaTIsTheObservedOne) {
  const testing_support::ReferenceTable t(TENKU_TEST_REFERENCE "/sun/positions.csv");
  testing_support::WorstError early("delta_t_1950_1972_s"), observed("delta_t_1973_2022_s"),
      late("delta_t_2023_2024_s");
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double date = t.number(i, "jd_ut1_int") + t.number(i, "jd_ut1_frac");
    const double year = 2000.0 + (date - 2451544.5) / 365.25;
    if (year > 2025.0) continue;
    (year < 1973.0   ? early
     : year < 2023.0 ? observed
                     : late)
        .add(delta_t_seconds(date) - t.number(i, "delta_t_s"), t.text(i, "ut1"));
  }
  EXPECT_LT(early.worst(), 0.7);
  EXPECT_LT(observed.worst(), 0.1);
  EXPECT_LT(late.worst(), 0.25);
}

// Espenak and Meeus 2006, table 2 (observed means): 1700, 1800, 1900 to their printed second.
TEST(TimeScales, HistoricalDeltaTIsThePublishedOne) {
  EXPECT_NEAR(delta_t_seconds(2341972.5), 9.0, 1.0);
  EXPECT_NEAR(delta_t_seconds(2378496.5), 14.0, 1.0);
  EXPECT_NEAR(delta_t_seconds(2415020.5), -3.0, 1.0);
}

TEST(TimeScales, Ut1StaysWithinASecondOfUtc) {
  for (int year = 1972; year <= 2050; ++year) {
    const Instant t = instant_from_utc({year, 6, 30, 12, 0, 0.0});
    const TimeScales scales = time_scales(t);
    const double dut1 = (scales.ut1.day - t.day + scales.ut1.fraction - t.fraction) * 86400.0;
    EXPECT_LT(std::abs(dut1), 0.95) << year;
  }
}

}  // namespace
}  // namespace tenku
