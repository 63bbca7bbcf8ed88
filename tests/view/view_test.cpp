#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "view/camera.h"
#include "view/false_colour.h"
#include "view/tone_map.h"
#include "view/value_scale.h"

namespace tenku {
namespace {

PerspectiveCamera looking(Vec3 direction) {
  return PerspectiveCamera({{1, 2, 3}, Vec3{1, 2, 3} + direction, Angle::degrees(90.0), 200, 100});
}

TEST(PerspectiveCamera, LookingNorthHasEastToTheRightAndTheZenithAtTheTop) {
  const PerspectiveCamera camera = looking({0, 10, 0});
  EXPECT_GT(camera.ray(150, 50).x, 0.1);
  EXPECT_LT(camera.ray(50, 50).x, -0.1);
  EXPECT_GT(camera.ray(100, 0).z, 0.1);
  EXPECT_LT(camera.ray(100, 100).z, -0.1);
}

TEST(PerspectiveCamera, LookingSouthHasWestToTheRight) {
  EXPECT_LT(looking({0, -10, 0}).ray(150, 50).x, -0.1);
}

TEST(PerspectiveCamera, FieldOfViewSpansTheWidth) {
  const PerspectiveCamera camera = looking({0, 10, 0});
  EXPECT_NEAR(angle_between(camera.ray(0, 50), camera.ray(200, 50)).in_degrees(), 90.0, 1e-9);
  EXPECT_NEAR(azimuth_of(camera.ray(200, 50)).in_degrees(), 45.0, 1e-9);
}

TEST(PerspectiveCamera, PixelsAreSquareAndOfTheFootprintsWidth) {
  const PerspectiveCamera camera = looking({0, 10, 0});
  EXPECT_NEAR(camera.footprint_m(10.0), 0.1, 1e-12);  // 2 * 10 m * tan 45 deg / 200
  const Vec3 a = camera.ray(100, 50), across = camera.ray(101, 50), down = camera.ray(100, 51);
  EXPECT_NEAR(length(across - a), length(down - a), 1e-12);
}

TEST(PerspectiveCamera, LookingStraightDownHasNorthAtTheTopAndEastToTheRight) {
  const PerspectiveCamera camera = looking({0, 0, -10});
  EXPECT_GT(camera.ray(100, 0).y, 0.1);
  EXPECT_GT(camera.ray(150, 50).x, 0.1);
}

TEST(PerspectiveCamera, APointAppearsWhereItsRayGoes) {
  const PerspectiveCamera camera = looking({3, 10, -2});
  const auto place = camera.pixel_of(camera.eye() + 17.0 * camera.ray(31.25, 77.5));
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x, 31.25, 1e-9);
  EXPECT_NEAR(place->y, 77.5, 1e-9);
  EXPECT_FALSE(camera.pixel_of(camera.eye() - camera.forward()));
}

TEST(PerspectiveCamera, RefusesWhatIsNoView) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(PerspectiveCamera({{0, 0, 0}, {0, 0, 0}}), InputError);
  EXPECT_THROW(PerspectiveCamera({{0, nan, 0}, {1, 0, 0}}), InputError);
  EXPECT_THROW(PerspectiveCamera({{0, 0, 0}, {1, 0, 0}, Angle::degrees(180.0)}), InputError);
  EXPECT_THROW(PerspectiveCamera({{0, 0, 0}, {1, 0, 0}, Angle::degrees(nan)}), InputError);
  EXPECT_THROW(PerspectiveCamera({{0, 0, 0}, {1, 0, 0}, Angle::degrees(60.0), 0, 10}), InputError);
}

TEST(PlanCamera, HasNorthAtTheTopAndEastToTheRight) {
  const PlanCamera camera({-100, -50, 100, 50, 400});
  EXPECT_EQ(camera.height(), 200);
  EXPECT_EQ(camera.point(0, 0, 5), (Vec3{-100, 50, 5}));
  EXPECT_EQ(camera.point(400, 200, 5), (Vec3{100, -50, 5}));
  EXPECT_NEAR(camera.pixel_of({50, 25, 0}).x, 300.0, 1e-12);
  EXPECT_NEAR(camera.pixel_of({50, 25, 0}).y, 50.0, 1e-12);
  EXPECT_THROW(PlanCamera({0, 0, 0, 1, 10}), InputError);
  EXPECT_THROW(PlanCamera({0, 0, 1, 1e9, 10}), InputError);
}

// Codes of IEC 61966-2-1 as published converters give them: 18 % grey is 118, 50 % is 188.
TEST(ToneMap, LinearCurveGivesTheStandardsCodes) {
  EXPECT_EQ(srgb_code(0.18), 118);
  EXPECT_EQ(srgb_code(0.5), 188);
  EXPECT_EQ(srgb_code(0.0), 0);
  EXPECT_EQ(srgb_code(7.0), 255);
  EXPECT_EQ(srgb_code(std::numeric_limits<double>::quiet_NaN()), 0);
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(srgb_code(linear_of_srgb(static_cast<std::uint8_t>(code))), code);
  }
}

TEST(ToneMap, LogAverageBecomesTheKey) {
  Image image(2, 2, Rgb::grey(100.0));
  image.at(0, 0) = Rgb::grey(10.0);
  image.at(1, 1) = Rgb::grey(1000.0);
  EXPECT_NEAR(exposure_of(image, {}), 0.18 / 100.0, 1e-12);
  image.at(0, 1) = Rgb::grey(std::numeric_limits<double>::infinity());
  image.at(1, 0) = {};
  EXPECT_NEAR(exposure_of(image, {}), 0.18 / 100.0, 1e-12) << "black and infinite do not count";
}

// ISO 12232 saturation-based: at EV 15 (ISO 100) white is 1.2 * 32768 cd/m2.
TEST(ToneMap, ExposureValueSetsWhite) {
  ToneMapOptions options;
  options.ev100 = 15.0;
  options.curve = ToneCurve::Linear;
  EXPECT_EQ(tone_map(Image(1, 1, Rgb::grey(39321.6)), options).at(0, 0), (Rgb8{255, 255, 255}));
  EXPECT_EQ(tone_map(Image(1, 1, Rgb::grey(0.18 * 39321.6)), options).at(0, 0),
            (Rgb8{118, 118, 118}));
  options.ev100 = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(tone_map(Image(1, 1), options), InputError);
}

TEST(ToneMap, CurvesRiseAndReinhardReachesWhiteAtTheBrightest) {
  Image ramp(256, 1);
  for (int x = 0; x < 256; ++x) ramp.at(x, 0) = Rgb::grey(10.0 * (x + 1));
  for (const ToneCurve curve : {ToneCurve::Filmic, ToneCurve::Reinhard, ToneCurve::Linear}) {
    ToneMapOptions options;
    options.curve = curve;
    const Image8 screen = tone_map(ramp, options);
    for (int x = 1; x < 256; ++x) EXPECT_GE(screen.at(x, 0).r, screen.at(x - 1, 0).r);
    EXPECT_LT(screen.at(0, 0).r, 60);
  }
  ToneMapOptions bright;
  bright.curve = ToneCurve::Reinhard;
  bright.key = 1.0;
  EXPECT_EQ(tone_map(ramp, bright).at(255, 0).r, 255);
  EXPECT_LT(tone_map(ramp, bright).at(200, 0).r, 255);
}

// Ten even steps of the original tables, as chart libraries publish them.
TEST(FalseColour, PolynomialsMeetTheOriginalTables) {
  const std::array<unsigned, 10> viridis{0x440154, 0x482878, 0x3e4989, 0x31688e, 0x26828e,
                                         0x1f9e89, 0x35b779, 0x6ece58, 0xb5de2b, 0xfde725};
  const std::array<unsigned, 10> inferno{0x000004, 0x1b0c41, 0x4a0c6b, 0x781c6d, 0xa52c60,
                                         0xcf4446, 0xed6925, 0xfb9b06, 0xf7d13d, 0xfcffa4};
  const auto check = [](ColourMap map, const std::array<unsigned, 10>& table) {
    for (unsigned i = 0; i < 10; ++i) {
      const Rgb8 c = colour_at(map, i / 9.0);
      EXPECT_NEAR(c.r, table[i] >> 16U, 10.0) << i;  // the fit's error of 0.04, of 255
      EXPECT_NEAR(c.g, table[i] >> 8U & 255U, 10.0) << i;
      EXPECT_NEAR(c.b, table[i] & 255U, 10.0) << i;
    }
  };
  check(ColourMap::Viridis, viridis);
  check(ColourMap::Inferno, inferno);
}

TEST(FalseColour, LightnessRisesEverywhere) {
  for (const ColourMap map : {ColourMap::Viridis, ColourMap::Inferno, ColourMap::Grey}) {
    double before = -1.0;
    for (int i = 0; i <= 50; ++i) {
      const Rgb8 c = colour_at(map, i / 50.0);
      const double y =
          luminance_of({linear_of_srgb(c.r), linear_of_srgb(c.g), linear_of_srgb(c.b)});
      EXPECT_GT(y, before);
      before = y;
    }
  }
}

TEST(FalseColour, WhatHasNoValueGetsAColourOfItsOwn) {
  const std::vector<double> values{0.0, std::numeric_limits<double>::quiet_NaN(), 5.0, 10.0};
  const Image8 image = false_colour(values, 2, {0.0, 10.0});
  EXPECT_EQ(image.at(1, 0), kNoValueColour);
  EXPECT_EQ(image.at(1, 1), colour_at(ColourMap::Viridis, 1.0));
}

TEST(ValueScale, EndsAndTicksAreRound) {
  const std::vector<double> values{0.3, 12.0, 87654.0, std::nan("")};
  const ValueScale scale = round_scale(values, false, 0.0);
  EXPECT_EQ(scale.low, 0.0);
  EXPECT_EQ(scale.high, 100000.0);
  EXPECT_EQ(scale.ticks(5), (std::vector<double>{0, 20000, 40000, 60000, 80000, 100000}));
  const ValueScale log_scale = round_scale(values, true, 0.0);
  EXPECT_DOUBLE_EQ(log_scale.low, 0.1);
  EXPECT_DOUBLE_EQ(log_scale.high, 100000.0);
  EXPECT_EQ(log_scale.ticks().size(), 7U);
  EXPECT_NEAR(log_scale.position_of(100.0), 0.5, 1e-12);
  EXPECT_NEAR(log_scale.value_at(0.5), 100.0, 1e-9);
}

TEST(ValueScale, DegenerateValuesStillGiveAScale) {
  for (const std::vector<double>& values :
       {std::vector<double>{}, {0.0}, {5.0, 5.0}, {-3.0, -3.0}, {-1.0, 2.0}}) {
    for (const bool logarithmic : {false, true}) {
      const ValueScale scale = round_scale(values, logarithmic);
      EXPECT_LT(scale.low, scale.high);
      EXPECT_GE(scale.ticks().size(), 2U);
    }
  }
  EXPECT_THROW(scale_between(1.0, 1.0), InputError);
  EXPECT_THROW(scale_between(0.0, 1.0, true), InputError);
}

TEST(NumberText, IsForReaders) {
  EXPECT_EQ(number_text(1234567.0), "1,234,567");
  EXPECT_EQ(number_text(-1234.5), "-1,234.5");
  EXPECT_EQ(number_text(-123.0), "-123");
  EXPECT_EQ(number_text(0.25), "0.25");
  EXPECT_EQ(number_text(-0.00001, 2), "-1e-05");
  EXPECT_EQ(rounded_text(64312.0), "64,300");
  EXPECT_EQ(rounded_text(0.012345), "0.0123");
  EXPECT_EQ(rounded_text(9.996), "10");
}

}  // namespace
}  // namespace tenku
