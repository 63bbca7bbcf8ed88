// Error numbers, fronts and knees of made-up measurements, and what fits into a time.
#include "study/speed_accuracy.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "core/error.h"

namespace tenku {
namespace {

TEST(ErrorNumbers, AreThoseOfTheirDefinitions) {
  const std::vector<double> truth{100.0, 200.0, 0.0, 50.0};
  const ErrorNumbers numbers = error_numbers({101.0, 196.0, 0.5, 50.0}, truth, 10.0);
  // 1 %, 2 %, 5 % of the floor, 0.
  EXPECT_NEAR(numbers.rms, std::sqrt((1.0 + 4.0 + 25.0) / 4.0), 1e-12);
  EXPECT_NEAR(numbers.p95, 5.0, 1e-12);
  EXPECT_NEAR(numbers.worst, 5.0, 1e-12);
  EXPECT_EQ(numbers.worst_sensor, 2U);
  EXPECT_NEAR(numbers.rms_lux, std::sqrt((1.0 + 16.0 + 0.25) / 4.0), 1e-12);
  EXPECT_NEAR(numbers.worst_lux, 4.0, 1e-12);
}

ChartPoint point(const char* method, double time_s, double rms, double spread_s = 0.0) {
  ChartPoint p;
  p.stage = "sky", p.method = method, p.setting = "x";
  p.time_s = time_s, p.time_spread_s = spread_s;
  p.error.rms = p.error.p95 = rms;
  return p;
}

TEST(SpeedAccuracy, FrontAndKneeAreFound) {
  ChartResult result;
  result.points = {point("a", 1.0, 10.0), point("a", 2.0, 1.0),   point("a", 10.0, 0.8),
                   point("b", 3.0, 5.0),  point("b", 100.0, 0.1), point("b", 0.5, 30.0)};
  rank_points(result);
  const std::vector<bool> front{true, true, true, false, true, true};
  for (std::size_t k = 0; k < front.size(); ++k) {
    EXPECT_EQ(result.points[k].is_on_front, front[k]) << k;
    EXPECT_EQ(result.points[k].is_knee, k == 1) << k;
  }
}

TEST(SpeedAccuracy, WhatIsUnderTheFloorIsNotRankedAndOverlapIsTold) {
  ChartResult result;
  result.points = {point("a", 1.0, 10.0, 0.8), point("a", 1.5, 5.0, 0.8), point("a", 9.0, 0.01)};
  result.points[2].is_under_floor = true;
  rank_points(result);
  EXPECT_FALSE(result.points[2].is_on_front);
  EXPECT_TRUE(result.points[0].is_order_unsure);
  EXPECT_TRUE(result.points[1].is_order_unsure);
}

TEST(SpeedAccuracy, TheCheapestWithinAnErrorIsRecommended) {
  ChartResult result;
  result.points = {point("a", 1.0, 10.0), point("a", 2.0, 1.9), point("b", 3.0, 0.9)};
  EXPECT_EQ(cheapest_within(result, 0, 2.0), &result.points[1]);
  EXPECT_EQ(cheapest_within(result, 0, 1.0), &result.points[2]);
  EXPECT_EQ(cheapest_within(result, 0, 0.5), nullptr);
  EXPECT_EQ(cheapest_within(result, 1, 2.0), nullptr);
}

/// A setting that waits and is wrong by a percentage.
ChartSetting waiting(const char* setting, double seconds, double wrong_pct) {
  return {"sky", "waits", setting, "", 0, [=](Progress& progress) {
            const auto end =
                std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
            while (std::chrono::steady_clock::now() < end) {
              progress.stop_if_cancelled();
              std::this_thread::sleep_for(std::chrono::milliseconds(5));
            }
            return SensorValues{{100.0 * (1.0 + 0.01 * wrong_pct)}, {1.0}};
          }};
}

TEST(SpeedAccuracy, EndsInTimeAndNamesWhatItLeftOut) {
  const ChartReference reference{"made up", {1.0}, [](double, std::uint64_t seed, Progress&) {
                                   return SensorValues{{seed % 2 == 0 ? 100.1 : 99.9}, {0.1}};
                                 }};
  Progress quiet;
  const ChartResult result = measure_chart(
      {waiting("quick", 0.02, 5.0), waiting("slow", 0.1, 1.0), waiting("endless", 60.0, 0.1)},
      {reference}, 1.0, 1e-6, 1, quiet);
  ASSERT_EQ(result.points.size(), 2U);
  EXPECT_NEAR(result.points[0].error.rms, 5.0, 1e-9);
  EXPECT_GE(result.points[1].time_s, 0.1);
  EXPECT_NEAR(result.references[0].floor, 0.1, 0.001);
  ASSERT_EQ(result.left_out.size(), 1U);
  EXPECT_NE(result.left_out[0].find("endless"), std::string::npos);
  EXPECT_LT(result.seconds, 30.0);  // not the minute of the endless one
}

}  // namespace
}  // namespace tenku
