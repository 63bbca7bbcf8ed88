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

// Beyond what was tried, as paths: four times as long at half the tolerance.
TEST(TimeLimit, GoesLittleBeyondTheFinestThatWasTried) {
  const std::vector<ExpectedTime> tried{{20.0, 1.0}, {10.0, 2.0}};
  EXPECT_NEAR(finest_within(tried, 4.5).tolerance_pct, 6.7, 1e-9) << "10 / 1.5, never finer";
  EXPECT_NEAR(finest_within(tried, 1000.0).tolerance_pct, 5.0, 1e-9);
  EXPECT_NEAR(finest_within(tried, 1000.0).expected_s, 8.0, 1e-9);
  EXPECT_NEAR(finest_within({{0.2, 1.0}, {0.1, 1.1}}, 1000.0).tolerance_pct, 0.1, 1e-9);
}

TEST(TimeLimit, SaysWhenEvenTheCoarsestTakesLonger) {
  const TimedTolerance chosen = finest_within({{20.0, 8.0}, {10.0, 16.0}}, 5.0);
  EXPECT_FALSE(chosen.is_reachable);
  EXPECT_EQ(chosen.tolerance_pct, 20.0);
  EXPECT_EQ(chosen.expected_s, 8.0);
}

TEST(TimeLimit, AsksUntilItKnows) {
  Progress quiet;
  // Times as one over the tolerance, where finer is first taken to cost its square.
  const TimeModel model = [](double tolerance) { return 200.0 / tolerance; };
  const TimedTolerance chosen = tolerance_within(model, 100.0, quiet);
  EXPECT_TRUE(chosen.is_reachable);
  EXPECT_GE(chosen.tolerance_pct, 200.0 / 85.0) << chosen.why;
  EXPECT_LE(chosen.tolerance_pct, 1.2 * 200.0 / 85.0) << chosen.why;
  EXPECT_NEAR(chosen.expected_s, model(chosen.tolerance_pct), 0.05 * chosen.expected_s);
  EXPECT_LE(chosen.tried.size(), 5U);
  EXPECT_EQ(tolerance_within(model, 1e6, quiet).tolerance_pct, kFinestTolerance_pct);
}

TEST(TimeLimit, StopsAskingWhereThatTakesLong) {
  Progress quiet;
  int asked = 0;
  const TimeModel slow = [&](double tolerance) {
    ++asked;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    return 2.0 / tolerance;
  };
  EXPECT_TRUE(tolerance_within(slow, 1.0, quiet).is_reachable);
  EXPECT_EQ(asked, 1) << "a second time would be beyond a quarter";
}

TEST(TimeLimit, SaysWhatCannotBeDone) {
  Progress quiet;
  const TimedTolerance chosen = tolerance_within([](double t) { return 1200.0 / t; }, 50.0, quiet);
  EXPECT_FALSE(chosen.is_reachable);
  EXPECT_EQ(chosen.tried.size(), 1U);
  EXPECT_NE(chosen.why.find("too short"), std::string::npos) << chosen.why;
  EXPECT_NE(chosen.why.find("60 s"), std::string::npos) << chosen.why;
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
