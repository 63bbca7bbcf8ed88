#include "study/time_limit.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "core/error.h"

namespace tenku {
namespace {

// Times that fall as one over the tolerance: the choice between two that were tried lies on that
// line.
TEST(TimeLimit, ChoosesBetweenTheTolerancesThatWereTried) {
  const std::vector<ExpectedTime> tried{{20.0, 1.0}, {10.0, 2.0}, {5.0, 4.0}, {2.0, 10.0}};
  const TimedTolerance chosen = finest_within(tried, 5.0);
  EXPECT_TRUE(chosen.is_reachable);
  EXPECT_NEAR(chosen.tolerance_pct, 4.0, 1e-9);
  EXPECT_NEAR(chosen.expected_s, 5.0, 1e-9);
}

TEST(TimeLimit, GoesLittleBeyondTheFinestThatWasTried) {
  const std::vector<ExpectedTime> tried{{20.0, 1.0}, {10.0, 2.0}};
  EXPECT_NEAR(finest_within(tried, 3.0).tolerance_pct, 6.7, 1e-9) << "20 / 3, never finer";
  EXPECT_NEAR(finest_within(tried, 1000.0).tolerance_pct, 5.0, 1e-9);
  EXPECT_NEAR(finest_within(tried, 1000.0).expected_s, 4.0, 1e-9);
  EXPECT_NEAR(finest_within({{0.2, 1.0}, {0.1, 1.1}}, 1000.0).tolerance_pct, 0.1, 1e-9);
}

TEST(TimeLimit, SaysWhenEvenTheCoarsestTakesLonger) {
  const TimedTolerance chosen = finest_within({{20.0, 8.0}, {10.0, 16.0}}, 5.0);
  EXPECT_FALSE(chosen.is_reachable);
  EXPECT_EQ(chosen.tolerance_pct, 20.0);
  EXPECT_EQ(chosen.expected_s, 8.0);
}

/// Work of a known time, in seconds: `fixed` and, in proportion to its share, `rest` at 20 %.
DivisibleWork asleep(double fixed, double rest) {
  return {20'000, [=](double share, double tolerance_pct, Progress&) {
            const double seconds = fixed + share * rest * 20.0 / tolerance_pct;
            std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
          }};
}

TEST(TimeLimit, ExpectsWhatTheWholeTakes) {
  Progress quiet;
  // 1 s at 20 %, 2 s at 10 %, 4 s at 5 %: 85 % of 4 s less the pilots allow some 7 %.
  const TimedTolerance chosen = tolerance_within(asleep(0.001, 1.0), 4.0, quiet);
  EXPECT_TRUE(chosen.is_reachable) << chosen.why;
  EXPECT_GT(chosen.tolerance_pct, 5.0) << chosen.why;
  EXPECT_LT(chosen.tolerance_pct, 10.0) << chosen.why;
  const double truth = 0.001 + 20.0 / chosen.tolerance_pct;
  EXPECT_NEAR(chosen.expected_s, truth, 0.25 * truth) << chosen.why;  // sleeping is that exact
}

TEST(TimeLimit, SpendsLittleOnWhatCannotBeDone) {
  Progress quiet;
  const auto start = std::chrono::steady_clock::now();
  const TimedTolerance chosen = tolerance_within(asleep(0.0, 60.0), 2.0, quiet);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_FALSE(chosen.is_reachable);
  EXPECT_NE(chosen.why.find("too short"), std::string::npos) << chosen.why;
  EXPECT_NEAR(chosen.expected_s, 60.0, 15.0);
  EXPECT_LT(took.count(), 2.0);
}

TEST(TimeLimit, IsReadInSecondsOrMinutes) {
  EXPECT_EQ(seconds_named("60", "a limit"), 60.0);
  EXPECT_EQ(seconds_named("90s", "a limit"), 90.0);
  EXPECT_EQ(seconds_named("2m", "a limit"), 120.0);
  for (const char* wrong : {"", "s", "0s", "-5s", "nan", "inf", "1h", "60 s", "1e9"}) {
    EXPECT_THROW(seconds_named(wrong, "a limit"), InputError) << wrong;
  }
}

}  // namespace
}  // namespace tenku
