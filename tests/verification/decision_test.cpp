// Sensors that are only told from a value.
#include "illuminance/decision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "support/random_town.h"

namespace tenku {
namespace {

using testing_support::random_town;
using testing_support::TestScene;

constexpr double kOpenSky_lux = 10'000.0;
using Of = DecisionThreshold::Of;

DaylightSource overcast() {
  DaylightSource source;
  const CieOvercastSky unit(Luminance(1.0));
  const double scale = kOpenSky_lux / SkyTable(unit).horizontal_lux();
  source.sky = std::make_unique<SkyTable>(CieOvercastSky(Luminance(scale)));
  return source;
}

TEST(DecisionThreshold, IsAnIlluminanceOrAShareOfTheOpenSky) {
  EXPECT_EQ(decision_threshold("300lx").of, Of::Total);
  EXPECT_EQ(decision_threshold("300 lx").lux(kOpenSky_lux), 300.0);
  EXPECT_EQ(decision_threshold("27%sky").of, Of::Skylight);
  EXPECT_DOUBLE_EQ(decision_threshold("27%sky").lux(kOpenSky_lux), 2700.0);
  for (const char* wrong : {"", "300", "lx", "-1lx", "0lx", "nanlx", "inflx", "1e9lx", "300lux",
                            "27%", "0%sky", "101%sky", "27sky", "300lx 2"}) {
    EXPECT_THROW(decision_threshold(wrong), InputError) << wrong;
  }
}

TEST(DecisionThreshold, IsClearOnlyOutsideTheInterval) {
  EXPECT_EQ(decided_by(310.0, 9.0, 300.0), Decided::Yes);
  EXPECT_EQ(decided_by(310.0, 10.0, 300.0), Decided::Undecided);
  EXPECT_EQ(decided_by(290.0, 9.0, 300.0), Decided::No);
  EXPECT_EQ(decided_by(290.0, std::nan(""), 300.0), Decided::Undecided);
}

/// A window in a wall before a long terrace whose top stands so high above it.
Decided window_before_terrace(double obstruction_deg) {
  constexpr double kAway_m = 20.0, kLong_m = 20'000.0;
  TestScene scene;
  scene.wall({-kLong_m, kAway_m, kLong_m, kAway_m}, -1.0,
             kAway_m * std::tan(obstruction_deg * kPi / 180.0));
  scene.wall({-kLong_m, -0.01, kLong_m, -0.01}, -1.0, 40.0);  // its own
  const RayVisibility rays(scene.soup, scene.materials);
  Sensors window;
  window.position.push_back({0.0, 0.0, 0.0});
  window.normal.push_back({0.0, 1.0, 0.0});
  IlluminanceOptions options;
  options.bounces = 0;
  options.decide = decision_threshold("27%sky");
  Progress quiet;
  return illuminate(window, rays, overcast(), options, quiet).decided.at(0);
}

// BRE 209 (P. Littlefair, "Site layout planning for daylight and sunlight"): a vertical sky
// component of 27 % is what a long obstruction of 25 degrees leaves.
TEST(Decisions, AnObstructionOf25DegreesIsAtTheVerticalSkyComponentOf27Percent) {
  EXPECT_EQ(window_before_terrace(23.0), Decided::Yes);
  EXPECT_EQ(window_before_terrace(27.0), Decided::No);
}

/// Sky and bounced light in a grey town, to a tolerance.
class TownDecisions : public testing::Test {
 protected:
  TownDecisions() {
    for (auto& m : town_.scene.materials) m = testing_support::grey_material(0.3);
    rays_ = std::make_unique<RayVisibility>(town_.scene.soup, town_.scene.materials);
    source_ = overcast();
  }
  IlluminanceResult light(double tolerance_pct, std::uint64_t seed,
                          const std::string& decide = "") {
    IlluminanceOptions options;
    options.tolerance_pct = tolerance_pct;
    options.bounces = 2;
    options.seed = seed;
    if (!decide.empty()) options.decide = decision_threshold(decide);
    Progress quiet;
    return illuminate(town_.sensors, *rays_, source_, options, quiet);
  }

  testing_support::Town town_ = random_town(150, 250.0, 100);
  std::unique_ptr<RayVisibility> rays_;
  DaylightSource source_;
};

TEST_F(TownDecisions, AreWrongNoOftenerThanIntervalsAllowAndSpareRays) {
  const IlluminanceResult truth = light(2.0, 77), all = light(5.0, 1);
  const std::size_t sensors = town_.sensors.size();
  std::vector<double> totals;
  for (std::size_t s = 0; s < sensors; ++s) totals.push_back(truth.values.total_lux(s));
  std::sort(totals.begin(), totals.end());
  const std::string median = std::to_string(totals[sensors / 2]) + "lx";
  for (const std::string& decide : {median, std::string("30%sky")}) {
    const IlluminanceResult found = light(5.0, 1, decide);
    const DecisionThreshold threshold = decision_threshold(decide);
    const double value = threshold.lux(kOpenSky_lux);
    std::size_t wrong = 0, decided = 0, outside = 0;
    for (std::size_t s = 0; s < sensors; ++s) {
      const auto lux = [&](const IlluminanceResult& r) {
        return threshold.of == Of::Total ? r.values.total_lux(s) : r.values.sky_lux[s];
      };
      outside += std::abs(found.values.total_lux(s) - truth.values.total_lux(s)) >
                 std::hypot(found.values.error_lux[s], truth.values.error_lux[s]);
      if (found.decided[s] == Decided::Undecided) {
        EXPECT_TRUE(found.is_missed[s] || std::abs(lux(truth) / value - 1.0) <= 0.05)
            << "far from it, and undecided";
        continue;
      }
      ++decided;
      wrong += (lux(truth) > value) != (found.decided[s] == Decided::Yes);
    }
    EXPECT_GT(decided, sensors * 9 / 10) << decide;
    EXPECT_LE(wrong, decided / 20) << decide;
    EXPECT_LE(outside, sensors / 9) << decide;  // 5 % and three standard errors of 100
    EXPECT_LT(found.rays, all.rays) << decide;
    EXPECT_LE(found.out_of_tolerance, sensors - decided) << "those decided need not be exact";
    std::printf("decide %s: %zu wrong of %zu, %zu outside, %.2f of the rays\n", decide.c_str(),
                wrong, decided, outside,
                static_cast<double>(found.rays) / static_cast<double>(all.rays));
  }
}

TEST_F(TownDecisions, NeedASkyForAShareOfIt) {
  source_.sky.reset();
  source_.sun.normal_illuminance = Illuminance(50'000.0);
  source_.sun.direction = direction_from(Angle::degrees(150.0), Angle::degrees(40.0));
  EXPECT_THROW(light(5.0, 1, "27%sky"), InputError);
}

}  // namespace
}  // namespace tenku
