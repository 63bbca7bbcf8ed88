#include "site/weather_file.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/error.h"

namespace tenku {
namespace {

const char* const kHeader =
    "LOCATION,Town,,X,made,0,46.8,13.5,1.0,560\nDESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\n"
    "GROUND TEMPERATURES,0\nHOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,x\nCOMMENTS 2,x\n"
    "DATA PERIODS,1,1,Data,Sunday,1/1,1/1\n";

std::string row(int hour, const std::string& direct, const std::string& diffuse) {
  return "2010,6,21," + std::to_string(hour) + ",60,x,20.5,12.5,60,95000,0,0,9999,0," + direct +
         "," + diffuse + ",0\n";
}

std::string day(const std::string& direct = "500", const std::string& diffuse = "100") {
  std::string text = kHeader;
  for (int hour = 1; hour <= 24; ++hour) text += row(hour, direct, diffuse);
  return text;
}

std::string message_of(const std::string& text) {
  try {
    parse_weather(text, "w.epw");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(WeatherFile, HourAndPlaceAreRead) {
  const WeatherFile file = parse_weather(day(), "w.epw");
  EXPECT_EQ(file.offset_minutes, 60);
  EXPECT_NEAR(file.location.latitude.in_degrees(), 46.8, 1e-9);
  const WeatherHour& hour = file.at(parse_time("2026-06-21T09:30+01:00").instant);
  EXPECT_EQ(hour.hour, 10);
  EXPECT_DOUBLE_EQ(hour.direct_normal->value(), 500.0);
  EXPECT_DOUBLE_EQ(hour.diffuse_horizontal->value(), 100.0);
  EXPECT_DOUBLE_EQ(*hour.dew_point_c, 12.5);
  EXPECT_DOUBLE_EQ(*hour.pressure_hpa, 950.0);
}

TEST(WeatherFile, MissingValuesAreAbsent) {
  const WeatherFile file = parse_weather(day("9999", "9999"), "w.epw");
  EXPECT_FALSE(file.hours.front().direct_normal);
  EXPECT_FALSE(file.hours.front().diffuse_horizontal);
}

TEST(WeatherFile, BrokenFilesSayWhere) {
  const std::string whole = day();
  EXPECT_NE(message_of("").find("line 1"), std::string::npos);
  EXPECT_NE(message_of("LOCATION,Town\n").find("line 1"), std::string::npos);
  EXPECT_NE(message_of(std::string(kHeader).substr(0, 120)).find("line"), std::string::npos);
  EXPECT_NE(message_of(kHeader).find("cut off"), std::string::npos);
  EXPECT_NE(message_of(whole.substr(0, whole.size() - 30)).find("line 32"), std::string::npos);
  EXPECT_NE(message_of(whole + row(1, "1", "1")).find("cut off"), std::string::npos);
  EXPECT_NE(message_of(day("-5")).find("line 9"), std::string::npos);
  EXPECT_NE(message_of(day("nan")).find("field 15"), std::string::npos);
  EXPECT_NE(message_of(day("many")).find("many"), std::string::npos);
}

const std::string kWea =
    "place Town_X\nlatitude 46.8\nlongitude -13.5\ntime_zone -15\nsite_elevation 560.0\n"
    "weather_data_file_units 1\n6 21 8.500 480 90\n6 21 9.500 500 100\n6 21 23.500 0 0\n";

TEST(WeaFile, SaysTheSameAsTheEpw) {
  const WeatherFile file = parse_weather(kWea, "w.wea");
  const WeatherFile epw = parse_weather(day(), "w.epw");
  EXPECT_EQ(file.offset_minutes, epw.offset_minutes);
  EXPECT_EQ(file.location.latitude, epw.location.latitude);
  EXPECT_EQ(file.location.longitude, epw.location.longitude);
  EXPECT_EQ(file.city, "Town_X");
  const WeatherHour& hour = file.at(parse_time("2026-06-21T09:30+01:00").instant);
  EXPECT_EQ(hour.hour, 10);
  EXPECT_DOUBLE_EQ(hour.direct_normal->value(), 500.0);
  EXPECT_DOUBLE_EQ(hour.diffuse_horizontal->value(), 100.0);
  EXPECT_FALSE(hour.dew_point_c);
}

TEST(WeaFile, PartsOfAnHourAreTold) {
  const std::string header = kWea.substr(0, kWea.find("6 21"));
  const WeatherFile file =
      parse_weather(header + "6 21 9.25 1 0\n6 21 9.75 2 0\n6 21 10.25 3 0\n6 21 10.75 4 0\n", "w");
  EXPECT_EQ(file.records_per_hour, 2);
  EXPECT_DOUBLE_EQ(file.at(parse_time("2026-06-21T10:40+01:00").instant).direct_normal->value(),
                   4.0);
}

TEST(WeaFile, BrokenFilesSayWhere) {
  const auto with = [](const std::string& old, const std::string& now) {
    return message_of(std::string(kWea).replace(kWea.find(old), old.size(), now));
  };
  EXPECT_NE(with("latitude", "altitude").find("line 2"), std::string::npos);
  EXPECT_NE(with("46.8", "146.8").find("146.8"), std::string::npos);
  EXPECT_NE(with("units 1", "units 2").find("units 1"), std::string::npos);
  EXPECT_NE(with("480 90", "480").find("line 7"), std::string::npos);
  EXPECT_NE(with("480 90", "-480 90").find("line 7"), std::string::npos);
  EXPECT_NE(with("8.500", "24.500").find("line 7"), std::string::npos);
  EXPECT_NE(with("6 21 8", "6 31 8").find("line 7"), std::string::npos);
  EXPECT_NE(message_of("place Town_X\n").find("latitude"), std::string::npos);
  EXPECT_NE(message_of(kWea.substr(0, kWea.find("6 21"))).find("cut off"), std::string::npos);
}

std::string with_place(const std::string& latitude, const std::string& zone) {
  std::string text = day();
  const std::string old = "46.8,13.5,1.0";
  return text.replace(text.find(old), old.size(), latitude + ",138.6," + zone);
}

// Adelaide: the other hemisphere, and half an hour beside the zones of whole hours.
TEST(WeatherFile, ZonesOfHalfHoursAndSouthernPlaces) {
  const WeatherFile file = parse_weather(with_place("-34.9", "9.5"), "w.epw");
  EXPECT_EQ(file.offset_minutes, 570);
  EXPECT_NEAR(file.location.latitude.in_degrees(), -34.9, 1e-12);
  EXPECT_EQ(file.at(parse_time("2026-06-21T03:29Z").instant).hour, 13);
  EXPECT_EQ(file.at(parse_time("2026-06-21T03:30Z").instant).hour, 14);
}

// Hour 24 ends with the day; what follows midnight is of the next.
TEST(WeatherFile, HoursEndWhenTheyAreStamped) {
  const WeatherFile file = parse_weather(day(), "w.epw");
  EXPECT_EQ(file.at(parse_time("2026-06-21T00:00+01:00").instant).hour, 1);
  EXPECT_EQ(file.at(parse_time("2026-06-21T23:59+01:00").instant).hour, 24);
  EXPECT_THROW((void)file.at(parse_time("2026-06-22T00:00+01:00").instant), InputError);
}

TEST(WeatherFile, AHourThatIsNotThereIsAnError) {
  const WeatherFile file = parse_weather(day(), "w.epw");
  EXPECT_THROW((void)file.at(parse_time("2026-07-21T09:30+01:00").instant), InputError);
}

TEST(WeatherFile, RealYearsAreReadWithLeapDays) {
  const char* data = std::getenv("TENKU_DATA");
  if (data == nullptr) GTEST_SKIP() << "TENKU_DATA is not set";
  const std::string folder = std::string(data) + "/weather/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no weather in TENKU_DATA";
  EXPECT_EQ(read_weather(folder + "US_CO_Boulder_AMY_2012_leap.epw").hours.size(), 8784u);
  const WeatherFile barrow = read_weather(folder + "USA_AK_Barrow_TMY2_converted.epw");
  EXPECT_EQ(barrow.hours.size(), 8760u);
  EXPECT_EQ(barrow.offset_minutes, -540);
  // no 29 February in a typical year: the 28th stands in
  EXPECT_EQ(barrow.at(parse_time("2024-02-29T12:30-09:00").instant).day, 28);
  // WEA made of the EPW by another program: every hour says the same
  const WeatherFile epw = read_weather(folder + "USA_CA_Oakland.Intl.AP.724930_TMY3.epw");
  const WeatherFile wea = read_weather(folder + "Oakland_from_epw.wea");
  ASSERT_EQ(wea.hours.size(), epw.hours.size());
  EXPECT_EQ(wea.offset_minutes, epw.offset_minutes);
  EXPECT_EQ(wea.location.longitude, epw.location.longitude);
  for (std::size_t h = 0; h < epw.hours.size(); ++h) {
    EXPECT_EQ(wea.hours[h].month, epw.hours[h].month);
    EXPECT_EQ(wea.hours[h].day, epw.hours[h].day);
    EXPECT_EQ(wea.hours[h].hour, epw.hours[h].hour);
    EXPECT_EQ(wea.hours[h].direct_normal, epw.hours[h].direct_normal);
    EXPECT_EQ(wea.hours[h].diffuse_horizontal, epw.hours[h].diffuse_horizontal);
  }
  EXPECT_EQ(read_weather(folder + "Radiance_test.wea").hours.size(), 56u);
  const WeatherFile komatsu = read_weather(folder + "JPN_Komatsu_METPV20_converted.epw");
  EXPECT_FALSE(komatsu.hours.front().dew_point_c);  // 99.9: missing
}

}  // namespace
}  // namespace tenku
