// Real cities all the way through the program, coarsely.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "support/reference_table.h"
#include "support/run_program.h"

namespace tenku {
namespace {

using testing_support::ProgramRun;
using testing_support::ReferenceTable;
using testing_support::run_tenku;
using testing_support::test_folder;

/// A scene of the data folder and the axis of its coordinates that points up.
struct City {
  const char* file;
  std::size_t up;
};

void PrintTo(const City& city, std::ostream* out) { *out << city.file; }

class RealCity : public testing::TestWithParam<City> {};

/// Sensors that look up: the first above everything, then 6 x 6 over the city, low down.
std::string sensors_over(const nlohmann::json& extent, std::size_t up) {
  std::ostringstream text;
  text.precision(12);
  const auto between = [&](std::size_t axis, double share) {
    const double low = extent["min"][axis], high = extent["max"][axis];
    return low + share * (high - low);
  };
  const auto add = [&](double u, double v, double height) {
    const std::size_t across = 0, along = up == 1 ? 2 : 1;
    double place[3] = {0, 0, 0};
    place[across] = between(across, u);
    place[along] = between(along, v);
    place[up] = height;
    text << place[0] << ' ' << place[1] << ' ' << place[2] << (up == 1 ? " 0 1 0" : " 0 0 1")
         << '\n';
  };
  add(0.5, 0.5, between(up, 1.0) + 1.0);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) add(0.25 + 0.1 * i, 0.25 + 0.1 * j, between(up, 0.15));
  }
  return text.str();
}

// Under a uniform sky of 10,000 lx with no sun nothing that looks up gets more skylight than that,
// and what is reflected once from surfaces of reflectance below 1 cannot exceed it either.
TEST_P(RealCity, IlluminanceIsBetweenNothingAndTheOpenSky) {
  const char* data = std::getenv("TENKU_DATA");
  if (data == nullptr) GTEST_SKIP() << "TENKU_DATA does not name the folder of real data";
  const auto folder = test_folder();
  std::string scene = "'";
  scene.append(data).append("/").append(GetParam().file).append("' --up ");
  scene += GetParam().up == 1 ? 'y' : 'z';
  const ProgramRun seen = run_tenku("inspect " + scene + " --json --quiet", folder);
  ASSERT_EQ(seen.exit_code, 0) << seen.err;
  std::ofstream(folder / "s.pts") << sensors_over(nlohmann::json::parse(seen.out)["extent"],
                                                  GetParam().up);
  const ProgramRun run =
      run_tenku("illuminance " + scene + " --sensors s.pts --sky uniform --sky-illuminance 10000" +
                    " --sun-illuminance 0 --tolerance 50 --bounces 1 --out o.csv",
                folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const ReferenceTable table((folder / "o.csv").string());
  ASSERT_EQ(table.size(), 37u);
  EXPECT_NEAR(table.number(0, "sky_lux"), 10000.0, 10.0);  // above the roofs
  std::size_t lit = 0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double sky = table.number(i, "sky_lux"), total = table.number(i, "total_lux");
    EXPECT_EQ(table.number(i, "sun_lux"), 0.0);
    EXPECT_GE(sky, 0.0);
    EXPECT_LE(sky, 10000.0 + table.number(i, "error_lux") + 0.01);
    EXPECT_GE(total, sky);
    EXPECT_LE(total, 20000.0);
    EXPECT_NEAR(table.number(i, "sky_view") * 10000.0, sky, 1.0 + 0.01 * sky);
    if (total > 100.0) ++lit;
  }
  EXPECT_GT(lit, 10u);
}

// The tile of The Hague is published in both encodings, with the same coordinates to a millimetre.
// The same seed draws the same samples, so that values are as close as their 95 % intervals and
// closer.
TEST(RealCityFormats, SameTileInCityGmlAndCityJsonHasTheSameIlluminance) {
  const char* data = std::getenv("TENKU_DATA");
  if (data == nullptr) GTEST_SKIP() << "TENKU_DATA does not name the folder of real data";
  const auto folder = test_folder();
  std::ofstream points(folder / "s.pts");
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < 10; ++j) {
      points << 78300 + 70 * i << ' ' << 457650 + 60 * j << " 12 0 0 1\n";
    }
  }
  points.close();
  const auto illuminance = [&](const std::string& file, const std::string& out) {
    const ProgramRun run =
        run_tenku("illuminance '" + std::string(data) + "/city/" + file + "' --sensors s.pts" +
                      " --sky cie-overcast --sky-illuminance 10000 --sun-illuminance 0" +
                      " --tolerance 2 --bounces 0 --out " + out,
                  folder);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return ReferenceTable((folder / out).string());
  };
  const ReferenceTable gml = illuminance("citygml/denhaag_tile01_citygml1.gml.gz", "gml.csv");
  const ReferenceTable json = illuminance("cityjson/denhaag_tile01_v10.city.json", "json.csv");
  ASSERT_EQ(gml.size(), 100u);
  ASSERT_EQ(json.size(), 100u);
  double darkest = 10000.0;
  for (std::size_t i = 0; i < gml.size(); ++i) {
    const double total = gml.number(i, "total_lux");
    EXPECT_NEAR(total, json.number(i, "total_lux"),
                gml.number(i, "error_lux") + json.number(i, "error_lux") + 0.1);
    darkest = std::min(darkest, total);
  }
  EXPECT_LT(darkest, 7000.0);  // among buildings, not above them
}

INSTANTIATE_TEST_SUITE_P(Cities, RealCity,
                         testing::Values(City{"city/cityjson/denhaag_tile01_v10.city.json", 2},
                                         City{"city/large/tokyo_minato_north_lod1.city.json.gz", 2},
                                         City{"city/large/linz_centre_lod2.obj.gz", 1}));

}  // namespace
}  // namespace tenku
