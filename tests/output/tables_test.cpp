#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "output/sensor_file.h"
#include "output/table_writer.h"
#include "tests/output/test_folder.h"

namespace tenku {
namespace {

TEST(TableWriter, NumbersReadBackAsTheSameDouble) {
  SampleRandom random(3, 1, 4);
  std::vector<double> values{0.0, -0.0, 0.1, 1.0 / 3.0, 1e300, 5e-324, 123456789.0, 100000.0};
  for (int i = 0; i < 2000; ++i) {
    const double value = std::bit_cast<double>(random.bits());
    if (value == value) values.push_back(value);
  }
  for (const double value : values) {
    const double back = std::strtod(shortest_text(value).c_str(), nullptr);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(value)) << value;
  }
  EXPECT_EQ(shortest_text(0.1), "0.1");
}

TEST(TableWriter, QuotesWhatNeedsQuotes) {
  EXPECT_EQ(csv_field("plain"), "plain");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("say \"x\"\n"), "\"say \"\"x\"\"\n\"");
}

TEST(TableWriter, IlluminanceHasTheContractsColumns) {
  SensorIlluminance results(1);
  results.sun_lux[0] = 100.5;
  results.sky_lux[0] = 20.25;
  results.reflected_lux[0] = 3.0;
  results.error_lux[0] = 0.5;
  results.sky_view[0] = 0.75;
  const std::vector<Vec3> position{{85000.125, 446000.5, 1.2}}, normal{{0, 0, 2}};
  EXPECT_EQ(illuminance_table(position, normal, results).text(),
            "x,y,z,nx,ny,nz,sun_lux,sky_lux,reflected_lux,total_lux,error_lux,sky_view\n"
            "85000.125,446000.5,1.2,0,0,2,100.5,20.25,3,123.75,0.5,0.75\n");
  const std::vector<Decided> decided{Decided::Yes};
  EXPECT_EQ(illuminance_table(position, normal, results, decided).text(),
            "x,y,z,nx,ny,nz,sun_lux,sky_lux,reflected_lux,total_lux,error_lux,sky_view,decided\n"
            "85000.125,446000.5,1.2,0,0,2,100.5,20.25,3,123.75,0.5,0.75,yes\n");
}

TEST(SensorFile, ReadsWhatRadianceUsersHave) {
  const Sensors sensors = sensors_from_text(
      "\xef\xbb\xbf# grid\r\n\r\n1 2 3 0 0 1\r\n\t4\t5.5\t-6e1 +1 0 0  # east\n   \n7 8 9 0 -2 0",
      "f");
  ASSERT_EQ(sensors.size(), 3U);
  EXPECT_EQ(sensors.position[1], (Vec3{4, 5.5, -60}));
  EXPECT_EQ(sensors.normal[1], (Vec3{1, 0, 0}));
  EXPECT_EQ(sensors.normal[2], (Vec3{0, -2, 0})) << "as the file gives it";
}

std::string refusal(const std::string& text) {
  try {
    sensors_from_text(text, "f.pts");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SensorFile, RefusesNamingTheLine) {
  EXPECT_EQ(refusal("1 2 3 0 0 1\n\n1 2 3 0 0\n"),
            "f.pts, line 3: 5 numbers where a sensor has six: x y z nx ny nz");
  EXPECT_EQ(refusal("1 2 3 0 0 1 7"),
            "f.pts, line 1: 7 numbers where a sensor has six: x y z nx ny nz");
  EXPECT_EQ(refusal("# a\n1 nan 3 0 0 1"), "f.pts, line 2: \"nan\" is not a finite number");
  EXPECT_EQ(refusal("1 1e999 3 0 0 1"), "f.pts, line 1: \"1e999\" is not a number");
  EXPECT_EQ(refusal("1 2 3x 0 0 1"), "f.pts, line 1: \"3x\" is not a number");
  EXPECT_NE(refusal("1 2 3 0 0 0").find("line 1: the normal has no usable length"),
            std::string::npos);
  EXPECT_NE(refusal("# nothing\n").find("holds no sensors"), std::string::npos);
  EXPECT_NE(refusal("").find("holds no sensors"), std::string::npos);
}

TEST(SensorFile, RefusesFilesThatCannotBeRead) {
  const TestFolder folder("pts");
  EXPECT_THROW(read_sensor_file(folder / "none.pts"), InputError);
  EXPECT_THROW(read_sensor_file(folder / "."), InputError);
}

}  // namespace
}  // namespace tenku
