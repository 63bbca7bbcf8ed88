#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/reference_table.h"
#include "support/run_program.h"

namespace tenku {
namespace {

using nlohmann::json;
using testing_support::contents_of;
using testing_support::ProgramRun;
using testing_support::ReferenceTable;
using testing_support::run_tenku;
using testing_support::test_folder;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// Angle between two directions given by azimuth and altitude in degrees.
double separation_deg(double azimuth_a, double altitude_a, double azimuth_b, double altitude_b) {
  const double u = std::sin(0.5 * kDegree * (altitude_a - altitude_b));
  const double v = std::sin(0.5 * kDegree * (azimuth_a - azimuth_b));
  const double h = u * u + std::cos(kDegree * altitude_a) * std::cos(kDegree * altitude_b) * v * v;
  return 2.0 * std::asin(std::sqrt(h)) / kDegree;
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

TEST(SunCommand, TableOfTheReferenceIsWithinAHundredThousandthOfADegree) {
  const auto folder = test_folder();
  const ReferenceTable t(TENKU_TEST_REFERENCE "/sun/positions.csv");
  std::string in =
      "time,latitude,longitude,elevation_m,pressure_hpa,temperature_c,delta_t_s,dut1_s\n";
  for (std::size_t i = 0; i < t.size(); ++i) {
    for (const char* column :
         {"ut1", "lat_deg", "lon_deg", "elev_m", "pressure_hPa", "temp_C", "delta_t_s"}) {
      in += t.text(i, column) + ",";
    }
    in += "0\n";
  }
  write(folder / "in.csv", in);
  const ProgramRun run = run_tenku("sun --times in.csv --out out.csv", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const ReferenceTable out((folder / "out.csv").string());
  ASSERT_EQ(out.size(), t.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    EXPECT_EQ(out.text(i, "time"), t.text(i, "ut1"));
    EXPECT_LT(separation_deg(out.number(i, "azimuth_deg"), out.number(i, "altitude_deg"),
                             t.number(i, "azimuth_deg"), t.number(i, "elevation_geom_deg")),
              1e-5)
        << t.text(i, "id");
    EXPECT_NEAR(90.0 - out.number(i, "apparent_altitude_deg"), t.number(i, "zenith_apparent_deg"),
                1e-5);
    EXPECT_NEAR(out.number(i, "equation_of_time_min"), t.number(i, "eot_min"), 1e-4);
  }
}

TEST(SunCommand, DayHasRiseNoonAndSetAndThePolesAnswer) {
  const auto folder = test_folder();
  const ProgramRun run = run_tenku(
      "sun --lat 39.742476 --lon -105.1786 --time 2015-01-02T12:00 --zone America/Denver --day "
      "--json --quiet",
      folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const json day = json::parse(run.out);
  // NREL SPA for Golden, in pvlib's tests: 07:21:55, 12:04:45, 16:47:43.
  EXPECT_EQ(day["rise"].get<std::string>().substr(0, 18), "2015-01-02T07:21:5");
  EXPECT_EQ(day["noon"].get<std::string>().substr(0, 18), "2015-01-02T12:04:4");
  EXPECT_EQ(day["set"].get<std::string>().substr(0, 18), "2015-01-02T16:47:4");
  EXPECT_EQ(day["day"], "normal");
  const json night = json::parse(
      run_tenku("sun --lat 78.2 --lon 15.6 --time 2026-12-21T12:00Z --day --json", folder).out);
  EXPECT_EQ(night["day"], "polar_night");
  EXPECT_TRUE(night["rise"].is_null());
  const json polar_day = json::parse(
      run_tenku("sun --lat 90 --lon 0 --time 2026-06-21T12:00Z --day --json", folder).out);
  EXPECT_EQ(polar_day["day"], "polar_day");
}

// NREL/TP-560-34302, appendix A.5.
TEST(SunCommand, NrelAlgorithmPrintsTheReportsExample) {
  const ProgramRun run = run_tenku(
      "sun --algorithm nrel --lat 39.742476 --lon -105.1786 --elevation 1830.14 --pressure 820 "
      "--temperature 11 --time 2003-10-17T12:30:30-07:00 --delta-t 67 --dut1 0 --json --quiet",
      test_folder());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json sun = json::parse(run.out);
  EXPECT_NEAR(sun["azimuth_deg"].get<double>(), 194.340241, 1e-6);
  EXPECT_NEAR(90.0 - sun["apparent_altitude_deg"].get<double>(), 50.111622, 1e-6);
}

TEST(SunCommand, WrongInputIsExitTwoAndLeavesNothing) {
  const auto folder = test_folder();
  write(folder / "bad.csv",
        "time,latitude,longitude,elevation_m\n2026-06-21T00:00,43,141,0\n"
        "2026-06-21T00:00,91,141,0\n");
  write(folder / "nan.csv", "time,latitude,longitude,elevation_m\n2026-06-21T00:00,nan,141,0\n");
  write(folder / "short.csv", "time,latitude,longitude,elevation_m\n2026-06-21T00:00,43\n");
  write(folder / "column.csv", "time,latitude\n2026-06-21T00:00,43\n");
  write(folder / "empty.csv", "");
  for (const auto& [arguments, word] : std::vector<std::pair<std::string, std::string>>{
           {"--lat 91 --lon 0 --time 2026-06-21T00:00Z", "latitude 91"},
           {"--lat nan --lon 0 --time 2026-06-21T00:00Z", "latitude"},
           {"--lat 43 --time 2026-06-21T00:00Z", "--lon"},
           {"--lat 43 --lon 141", "--time"},
           {"--lat 48 --lon 2 --time 2026-03-29T02:30 --zone Europe/Paris", "never happens"},
           {"--lat 48 --lon 2 --time 2026-10-25T02:30 --zone Europe/Paris", "happens twice"},
           {"--lat 48 --lon 2 --time 2026-10-25T02:30 --zone Europe/Pari", "Europe/Pari"},
           {"--lat 48 --lon 2 --time noon", "'noon'"},
           {"--times bad.csv --out out.csv", "bad.csv, line 3"},
           {"--times nan.csv --out out.csv", "nan.csv, line 2"},
           {"--times short.csv --out out.csv", "short.csv, line 2"},
           {"--times column.csv --out out.csv", "longitude"},
           {"--times empty.csv --out out.csv", "empty"},
           {"--times missing.csv --out out.csv", "missing.csv"},
           {"--times . --out out.csv", "folder"},
           {"--times bad.csv", "--out"},
           {"--lat 1 --lon 1 --time 2026-06-21T00:00Z --out no/such/out.csv", "no/such"}}) {
    const ProgramRun run = run_tenku("sun " + arguments, folder);
    EXPECT_EQ(run.exit_code, 2) << arguments << "\n" << run.err;
    EXPECT_NE(run.err.find(word), std::string::npos) << arguments << "\n" << run.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out.csv"));
}

// ISO 15469 by the reference table, at a level of 10,000 lx.
TEST(SkyCommand, LuminancesAreTheStandards) {
  const auto folder = test_folder();
  const ReferenceTable t(TENKU_TEST_REFERENCE "/sky/cie_luminance.csv");
  std::string in = "azimuth_deg,altitude_deg\n180,90\n";
  std::vector<double> expected{1.0};
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t.text(i, "sky_type") != "12" || t.text(i, "sun_alt_deg") != "35") continue;
    in += t.text(i, "az_deg") + "," + t.text(i, "alt_deg") + "\n";
    expected.push_back(t.number(i, "L_over_Lz"));
  }
  ASSERT_GT(expected.size(), 10u);
  write(folder / "in.csv", in);
  const ProgramRun run = run_tenku(
      "sky --sky cie:12 --sun-altitude 35 --sun-azimuth 180 --sky-illuminance 10000 "
      "--directions in.csv --out out.csv --json",
      folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const ReferenceTable out((folder / "out.csv").string());
  ASSERT_EQ(out.size(), expected.size());
  const double zenith = out.number(0, "luminance_cd_m2");
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(out.number(i, "luminance_cd_m2") / zenith, expected[i], 1e-7 * expected[i]);
  }
  const json summary = json::parse(run.out);
  EXPECT_NEAR(summary["horizontal_diffuse_lux"].get<double>(), 10000.0, 1e-6);
  EXPECT_NEAR(summary["zenith_luminance_cd_m2"].get<double>(), zenith, 1e-9 * zenith);
  EXPECT_GT(summary["elements"].get<int>(), 100);
  EXPECT_TRUE(summary["diagnostics"].empty());
}

TEST(SkyCommand, ElementsAddUpToTheSky) {
  const auto folder = test_folder();
  const ProgramRun run = run_tenku(
      "sky --sky uniform --sky-illuminance 10000 --partition tregenza --out e.csv", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const ReferenceTable e((folder / "e.csv").string());
  ASSERT_EQ(e.size(), 145u);
  double solid_angle = 0.0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    solid_angle += e.number(i, "solid_angle_sr");
    EXPECT_NEAR(e.number(i, "luminance_cd_m2"), 10000.0 / 3.14159265358979, 1e-6);
  }
  EXPECT_NEAR(solid_angle, 2.0 * 3.14159265358979323846, 1e-12);
}

TEST(SkyCommand, NightIsDarkButDone) {
  const ProgramRun run =
      run_tenku("sky --sky cie:12 --sun-altitude -3 --sun-azimuth 90 --json", test_folder());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const json summary = json::parse(run.out);
  EXPECT_EQ(summary["horizontal_diffuse_lux"].get<double>(), 0.0);
  EXPECT_EQ(summary["diagnostics"][0]["code"], "night");
}

TEST(SkyCommand, WrongInputIsExitTwo) {
  const auto folder = test_folder();
  write(folder / "high.csv", "azimuth_deg,altitude_deg\n0,45\n0,95\n");
  const std::string sun = " --sun-altitude 40 --sun-azimuth 90 --json";
  for (const auto& [arguments, word] : std::vector<std::pair<std::string, std::string>>{
           {"--sky cei:12" + sun, "'cie:12'"},
           {"--sky cie:16" + sun, "1..15"},
           {"--sky perez:-1,2" + sun, "negative"},
           {"--sky uniform --sky-illuminance -1" + sun, "-1"},
           {"--sky uniform --sky-illuminance nan" + sun, "nan"},
           {"--sky uniform --sun-illuminance inf" + sun, "inf"},
           {"--sky cie:12 --sun-altitude 91 --sun-azimuth 0 --json", "91"},
           {"--sky cie:12 --sun-altitude nan --sun-azimuth 0 --json", "nan"},
           {"--sky cie:12 --sun-altitude 40 --json", "--sun-azimuth"},
           {"--sky cie:12 --json", "--sun-altitude"},
           {"--sky weather:missing.epw" + sun, "--time"},
           {"--sky image:missing.hdr" + sun, "missing.hdr"},
           {"--sky uniform --elements 0" + sun, "0"},
           {"--sky uniform --partition reinhart:9" + sun, "reinhart:9"},
           {"--sky uniform --directions high.csv --out o.csv" + sun, "high.csv, line 3"},
           {"--sky uniform --out o.txt" + sun, "o.txt"},
           {"--sky uniform --sun-altitude 40 --sun-azimuth 90", "--out"}}) {
    const ProgramRun run = run_tenku("sky " + arguments, folder);
    EXPECT_EQ(run.exit_code, 2) << arguments << "\n" << run.err;
    EXPECT_NE(run.err.find(word), std::string::npos) << arguments << "\n" << run.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "o.csv"));
}

}  // namespace
}  // namespace tenku
