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
  const WeatherFile komatsu = read_weather(folder + "JPN_Komatsu_METPV20_converted.epw");
  EXPECT_FALSE(komatsu.hours.front().dew_point_c);  // 99.9: missing
}

}  // namespace
}  // namespace tenku
