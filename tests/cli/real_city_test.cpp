// Real cities all the way through the program, coarsely.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "support/reference_table.h"
#include "support/run_program.h"

namespace tenku {
namespace {

using testing_support::ProgramRun;
using testing_support::ReferenceTable;
using testing_support::run_tenku;
using testing_support::test_folder;

/// A scene of the data folder, and what to ask of it.
struct City {
  const char* file;
  const char* arguments;  ///< where the sensors are
};

void PrintTo(const City& city, std::ostream* out) { *out << city.file; }

class RealCity : public testing::TestWithParam<City> {};

// Under a uniform sky of 10,000 lx with no sun nothing gets more skylight than that, and the
// default materials reflect less than all of it: below twice the open sky (a plane between two
// perfect mirrors of the sky would see at most one more).
TEST_P(RealCity, IlluminanceIsBetweenNothingAndTheOpenSky) {
  const char* data = std::getenv("TENKU_DATA");
  if (data == nullptr) GTEST_SKIP() << "TENKU_DATA does not name the folder of real data";
  const auto folder = test_folder();
  const ProgramRun run = run_tenku(
      "illuminance '" + std::string(data) + "/" + GetParam().file + "' " + GetParam().arguments +
          " --sky uniform --sky-illuminance 10000 --sun-illuminance 0 --tolerance 20 --bounces 1"
          " --out o.csv --json",
      folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const ReferenceTable table((folder / "o.csv").string());
  ASSERT_GT(table.size(), 10u);
  double most = 0.0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double sky = table.number(i, "sky_lux"), total = table.number(i, "total_lux");
    EXPECT_EQ(table.number(i, "sun_lux"), 0.0);
    EXPECT_GE(sky, 0.0);
    EXPECT_LE(sky, 10000.0 * 1.02 + table.number(i, "error_lux"));
    EXPECT_GE(total, sky);
    EXPECT_LE(total, 20000.0);
    EXPECT_NEAR(table.number(i, "sky_view") * 10000.0, sky, 1.0 + 0.01 * sky);
    most = std::max(most, total);
  }
  EXPECT_GT(most, 6000.0);  // some roof sees nearly all of the sky
}

INSTANTIATE_TEST_SUITE_P(
    Cities, RealCity,
    testing::Values(City{"city/cityjson/denhaag_tile01_v10.city.json", "--grid roofs --spacing 30"},
                    City{"city/large/tokyo_minato_north_lod1.city.json.gz",
                         "--grid roofs --spacing 100"},
                    City{"city/large/linz_centre_lod2.obj.gz", "--grid roofs --spacing 200"}));

}  // namespace
}  // namespace tenku
