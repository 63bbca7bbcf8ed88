#include "core/altitude.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tenku {
namespace {

TEST(Altitude, AngleOfASlopeIsTheArctangent) {
  for (double slope = 1e-6; slope < 1e7; slope *= 1.01) {
    EXPECT_NEAR(arctangent(slope), std::atan(slope), 2e-8);
    EXPECT_NEAR(arctangent(-slope), -std::atan(slope), 2e-8);
  }
  EXPECT_EQ(arctangent(0.0), 0.0);
}

TEST(Altitude, OfASlopeHasItsSineAndCosine) {
  for (double degrees = -89.0; degrees < 90.0; degrees += 0.7) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Altitude at = Altitude::of_slope(std::tan(angle));
    EXPECT_NEAR(at.radians, angle, 2e-8);
    EXPECT_NEAR(at.sine, std::sin(angle), 1e-14);
    EXPECT_NEAR(at.cosine, std::cos(angle), 1e-14);
  }
}

TEST(Altitude, TurnsBySmallAndLargeAngles) {
  for (const double turn : {1e-9, 1e-5, 9.9e-4, 1.1e-3, 0.3, -2e-4, -1.2}) {
    const Altitude at = Altitude::of(0.7).turned(turn);
    EXPECT_NEAR(at.radians, 0.7 + turn, 1e-15);
    EXPECT_NEAR(at.sine, std::sin(0.7 + turn), 1e-15);
    EXPECT_NEAR(at.cosine, std::cos(0.7 + turn), 1e-15);
  }
}

}  // namespace
}  // namespace tenku
