#include <gtest/gtest.h>

#include "site/sun_path.h"
#include "support/measured.h"
#include "support/reference_table.h"

namespace tenku {
namespace {

using testing_support::ReferenceTable;
using testing_support::WorstError;

Location place(double latitude_deg, double longitude_deg) {
  return {Angle::degrees(latitude_deg), Angle::degrees(longitude_deg), 0.0};
}

Instant at(const std::string& utc) { return parse_time(utc + "Z").instant; }

// The reference's own checks differ by up to 10 s at grazing high-latitude cases: 2 s below 55
// degrees of latitude, 15 s elsewhere.
TEST(SunDay, RiseNoonAndSetAgreeWithTheReference) {
  const ReferenceTable t(TENKU_TEST_REFERENCE "/sun/rise_set.csv");
  WorstError low("rise_set_below_55_deg_s"), high("rise_set_above_55_deg_s"), noon("solar_noon_s"),
      azimuth("rise_set_azimuth_deg");
  for (std::size_t i = 0; i < t.size(); ++i) {
    SunOptions options;
    options.rotation = {t.number(i, "delta_t_s"), 0.0};
    const SunDay day = sun_day(place(t.number(i, "lat_deg"), t.number(i, "lon_deg")),
                               at(t.text(i, "transit_ut1")), options);
    const std::string &id = t.text(i, "id"), &status = t.text(i, "status");
    EXPECT_EQ(name_of(day.kind), status) << id;
    noon.add(seconds_between(at(t.text(i, "transit_ut1")), day.noon), id);
    if (status != "normal") continue;
    ASSERT_TRUE(day.rise && day.set) << id;
    WorstError& error = std::abs(t.number(i, "lat_deg")) < 55.0 ? low : high;
    error.add(seconds_between(at(t.text(i, "sunrise_ut1")), *day.rise), id);
    error.add(seconds_between(at(t.text(i, "sunset_ut1")), *day.set), id);
    azimuth.add(day.rise_azimuth->in_degrees() - t.number(i, "sunrise_azimuth_deg"), id);
    azimuth.add(day.set_azimuth->in_degrees() - t.number(i, "sunset_azimuth_deg"), id);
  }
  EXPECT_LT(low.worst(), 0.1);
  EXPECT_LT(high.worst(), 1.0);
  EXPECT_LT(noon.worst(), 0.5);
  EXPECT_LT(azimuth.worst(), 0.01);
}

// NREL/TP-560-34302, table A2.1 and pvlib's tests: UT, printed to the second.
TEST(SunDay, RiseAndSetAreThoseOfTheNrelReport) {
  struct Case {
    double latitude;
    const char *around, *rise, *set;
  };
  const Case cases[] = {
      {-35.0, "1996-07-05T12:00", "1996-07-05T07:08:15", "1996-07-05T17:01:04"},
      {-35.0, "2004-12-04T12:00", "2004-12-04T04:38:57", "2004-12-04T19:02:03"},
      {35.0, "1994-01-02T12:00", "1994-01-02T07:08:12", "1994-01-02T16:59:55"},
  };
  for (const Case& c : cases) {
    const SunDay day = sun_day(place(c.latitude, 0.0), at(c.around));
    EXPECT_NEAR(seconds_between(at(c.rise), *day.rise), 0.0, 1.6);  // printed seconds, UT1 - UTC
    EXPECT_NEAR(seconds_between(at(c.set), *day.set), 0.0, 1.6);
  }
}

TEST(SunDay, TrueSolarTimeIsNoonAtNoonAndRunsWithTheSun) {
  const Location site = place(43.06, 141.35);
  const SunDay day = sun_day(site, at("2026-06-21T03:00"));
  EXPECT_NEAR(true_solar_hours(sun_at(site, day.noon)), 12.0, 1e-6);
  EXPECT_NEAR(true_solar_hours(sun_at(site, later_by(day.noon, 3.0 * 3600.0))), 15.0, 1e-3);
  EXPECT_NEAR(sun_at(site, day.noon).azimuth.in_degrees(), 180.0, 0.01);
}

TEST(SunPath, ArcsAndHourLinesStayAboveTheHorizonAndMeetAtTheirInstants) {
  const SunPath path = sun_path(place(43.06, 141.35), 2026, 540);
  ASSERT_EQ(path.day_arcs.size(), 12u);
  for (const SunPathLine& arc : path.day_arcs) {
    ASSERT_GT(arc.points.size(), 10u);
    for (const SunPathPoint& p : arc.points) EXPECT_GE(p.altitude.in_degrees(), 0.0);
  }
  // 21 June: 90 - latitude + obliquity, with a hundredth of a degree of refraction.
  double highest = 0.0;
  for (const SunPathPoint& p : path.day_arcs[5].points) {
    highest = std::max(highest, p.altitude.in_degrees());
  }
  EXPECT_NEAR(highest, 90.0 - 43.06 + 23.44, 0.05);
  for (const SunPathLine& line : path.hour_lines) {
    if (line.number == 12) {
      EXPECT_EQ(line.points.size(), 72u);
    }
  }
}

TEST(SunPath, PolarNightLeavesItsMonthsEmpty) {
  const SunPath path = sun_path(place(78.2, 15.6), 2026, 60);
  EXPECT_TRUE(path.day_arcs[11].points.empty());
  EXPECT_GT(path.day_arcs[5].points.size(), 100u);
}

// National Astronomical Observatory of Japan: rise, noon and set of Kaga for 2023.
TEST(SunDay, AgreesWithTheNaojTableOfAYear) {
  const char* data = std::getenv("TENKU_DATA");
  if (data == nullptr) GTEST_SKIP() << "TENKU_DATA is not set";
  std::ifstream file(std::string(data) + "/weather/oracle_NAOJ_sun_Kaga_2023.csv");
  if (!file) GTEST_SKIP() << "no oracle_NAOJ_sun_Kaga_2023.csv in TENKU_DATA/weather";
  WorstError noon("naoj_noon_s"), altitude("naoj_noon_altitude_deg"), rise("naoj_rise_set_min");
  std::string line;
  for (int skipped = 0; skipped < 3; ++skipped) std::getline(file, line);
  const Location site = place(36.3028, 136.3150);
  std::size_t days = 0;
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::string date, up, up_azimuth, transit, top, down, part;
    for (std::string* cell : {&date, &up, &up_azimuth, &transit, &top, &down}) {
      std::getline(cells, *cell, ',');
    }
    int year = 0, month = 0, day_number = 0, h = 0, m = 0, s = 0, uh = 0, um = 0, dh = 0, dm = 0;
    if (std::sscanf(date.c_str(), "%d/%d/%d", &year, &month, &day_number) != 3) continue;
    ASSERT_EQ(std::sscanf(transit.c_str(), "%d:%d:%d", &h, &m, &s), 3) << line;
    ASSERT_EQ(std::sscanf(up.c_str(), "%d:%d", &uh, &um), 2) << line;
    ASSERT_EQ(std::sscanf(down.c_str(), "%d:%d", &dh, &dm), 2) << line;
    const Instant midnight =
        later_by(instant_from_utc({year, month, day_number, 0, 0, 0.0}), -9.0 * 3600.0);
    const SunDay day = sun_day(site, later_by(midnight, 12.0 * 3600.0));
    noon.add(seconds_between(midnight, day.noon) - (h * 3600.0 + m * 60.0 + s), date);
    altitude.add(sun_at(site, day.noon).apparent_altitude.in_degrees() - std::stod(top), date);
    rise.add(seconds_between(midnight, *day.rise) / 60.0 - (uh * 60.0 + um), date);
    rise.add(seconds_between(midnight, *day.set) / 60.0 - (dh * 60.0 + dm), date);
    ++days;
  }
  EXPECT_EQ(days, 365u);
  EXPECT_LT(noon.worst(), 1.0);       // printed to the second
  EXPECT_LT(altitude.worst(), 0.06);  // printed to 0.1 degrees
  EXPECT_LT(rise.worst(), 1.05);      // printed to the minute; NAOJ's convention differs by seconds
}

}  // namespace
}  // namespace tenku
