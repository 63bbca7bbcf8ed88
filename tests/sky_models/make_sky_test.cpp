#include "sky_models/make_sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "sky_models/hemisphere_integral.h"
#include "sky_models/image_sky.h"
#include "sky_models/sky_level.h"
#include "sky_models/sky_name.h"
#include "support/measured.h"
#include "support/reference_table.h"

namespace tenku {
namespace {

SkyRequest request(const std::string& model, std::optional<double> sun_altitude_deg = 40.0) {
  SkyRequest r;
  r.model = model;
  if (sun_altitude_deg) {
    r.sun = SunInSky{direction_from(Angle::degrees(160), Angle::degrees(*sun_altitude_deg)),
                     Angle::degrees(0.2666), 1.0};
  }
  return r;
}

std::string message_of(const SkyRequest& r) {
  try {
    (void)make_sky(r);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool has_finding(const Sky& sky, const std::string& code) {
  for (const Finding& f : sky.diagnostics) {
    if (f.code == code) return true;
  }
  return false;
}

/// A Radiance picture, flat (not run-length coded), of one value in the upper half.
std::filesystem::path write_picture(const std::string& name, int width, int height) {
  const auto path = std::filesystem::path(::testing::TempDir()) / name;
  std::ofstream file(path, std::ios::binary);
  file << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " << height << " +X " << width << "\n";
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      // 2 in the eastern quarter around azimuth 90, 1 elsewhere: mantissa 128 with exponents 130,
      // 129
      const bool is_east = x >= 5 * width / 8 && x < 7 * width / 8;
      const char pixel[4] = {'\x80', '\x80', '\x80', is_east ? '\x82' : '\x81'};
      file.write(pixel, 4);
    }
  }
  return path;
}

TEST(MakeSky, EveryModelHasTheLevelAskedFor) {
  for (const char* model :
       {"uniform", "cie-overcast", "cie:1", "cie:7", "cie:12", "cie:15", "perez:500,120"}) {
    SkyRequest r = request(model);
    r.sky_illuminance = Illuminance(12345.0);
    const Sky sky = make_sky(r);
    ASSERT_TRUE(sky.model) << model;
    EXPECT_NEAR(horizontal_illuminance(*sky.model, r.sun->direction).value(), 12345.0, 0.01)
        << model;
    EXPECT_NEAR(sky.horizontal_diffuse_lux, 12345.0, 1e-6) << model;
  }
}

// Horizontal illuminance of the traditional overcast sky is 7 pi / 9 of its zenith luminance.
TEST(MakeSky, OvercastZenithIsThatOfTheFormula) {
  SkyRequest r = request("cie-overcast", std::nullopt);
  r.sky_illuminance = Illuminance(10000.0);
  EXPECT_NEAR(make_sky(r).luminance(kZenith).value(), 4092.56, 0.01);
}

// Krochmann and Seidl: 300 + 21000 sin(30 degrees).
TEST(MakeSky, OvercastLevelIsThePublishedOne) {
  EXPECT_NEAR(make_sky(request("cie-overcast", 30.0)).horizontal_diffuse_lux, 10800.0, 1e-6);
  EXPECT_NEAR(make_sky(request("uniform", 30.0)).horizontal_diffuse_lux, 10800.0, 1e-6);
}

// Darula and Kittler 2002 fit Lz / Ehd for each type (B, C, D, E of their table); their fit for
// types 1, 3, 5 is exact to four digits: zenith of 0.10 x 54.63, 0.15 x 48.30, 0.20 x 42.59 kcd/m2
// times the sine of the sun's altitude.
TEST(MakeSky, OvercastTypesHaveTheTypicalZenith) {
  const double sine = std::sin(40.0 * kPi / 180.0);
  EXPECT_NEAR(make_sky(request("cie:1")).luminance(kZenith).value(), 5463.0 * sine, 2.0);
  EXPECT_NEAR(make_sky(request("cie:3")).luminance(kZenith).value(), 7245.0 * sine, 2.0);
  EXPECT_NEAR(make_sky(request("cie:5")).luminance(kZenith).value(), 8518.0 * sine, 2.0);
  EXPECT_EQ(make_sky(request("cie:3")).sun.normal_illuminance.value(), 0.0);
}

// Clear skies: diffuse 10 to 20 klx and a sun of 80 to 105 klx at 45 degrees are what handbooks
// give (IESNA Lighting Handbook, 9th edition, figure 8-3: 15 klx and 90 klx).
TEST(MakeSky, ClearSkiesAreAsBrightAsClearSkies) {
  const Sky sky = make_sky(request("cie:12", 45.0));
  EXPECT_GT(sky.horizontal_diffuse_lux, 10000.0);
  EXPECT_LT(sky.horizontal_diffuse_lux, 20000.0);
  EXPECT_GT(sky.sun.normal_illuminance.value(), 80000.0);
  EXPECT_LT(sky.sun.normal_illuminance.value(), 105000.0);
}

// Table 2 of Darula and Kittler 2002 as other programs carry it, A = A1 Tv + A2 rounded to 0.01;
// the ratio of zenith luminance to horizontal illuminance from quadrature.
TEST(MakeSky, LevelsAreThoseOfThePublishedTable) {
  const testing_support::ReferenceTable levels(TENKU_TEST_REFERENCE "/sky/cie_levels.csv");
  const testing_support::ReferenceTable integrals(TENKU_TEST_REFERENCE "/sky/cie_integrals.csv");
  testing_support::WorstError zenith("level_zenith_7_15"), diffuse("level_diffuse_1_6");
  for (std::size_t i = 0; i < integrals.size(); ++i) {
    const double altitude = integrals.number(i, "sun_alt_deg");
    if (integrals.text(i, "quantity") != "Lz_over_Ehd_per_sr" || altitude > 75.0) continue;
    const auto type = static_cast<int>(integrals.number(i, "sky_type"));
    if (type > 15) continue;  // the traditional overcast sky
    const auto of = [&](const char* name) {
      return levels.number(static_cast<std::size_t>(type) - 1, name);
    };
    const double lux = cie_sky_level(type, Angle::degrees(altitude)).horizontal_diffuse.value();
    const double s = std::sin(altitude * kPi / 180.0), c = std::cos(altitude * kPi / 180.0);
    if (type <= 6) {
      diffuse.add(lux / (133800.0 * s * of("diffuse_ratio")) - 1.0, std::to_string(type));
      continue;
    }
    const double kcd = of("a") * s +
                       0.7 * (of("turbidity") + 1.0) * std::pow(s, of("c")) / std::pow(c, of("d")) +
                       0.04 * of("turbidity");
    zenith.add(lux * integrals.number(i, "value") / (1000.0 * kcd) - 1.0, std::to_string(type));
  }
  EXPECT_LT(diffuse.worst(), 1e-12);
  EXPECT_LT(zenith.worst(), 0.002);  // A is rounded to 0.01, of 3.3 at least
}

TEST(MakeSky, LevelsAreSmoothUpToTheZenith) {
  for (int type = 1; type <= 15; ++type) {
    double last = 0.0;
    for (double altitude = 1.0; altitude <= 90.0; altitude += 1.0) {
      const CieSkyLevel level = cie_sky_level(type, Angle::degrees(altitude));
      ASSERT_TRUE(std::isfinite(level.horizontal_diffuse.value()));
      EXPECT_GT(level.horizontal_diffuse.value(), 0.99 * last) << type << " at " << altitude;
      if (altitude > 2.0) {
        EXPECT_LT(level.horizontal_diffuse.value(), 1.6 * last);
      }
      last = level.horizontal_diffuse.value();
    }
  }
}

TEST(MakeSky, NightIsDarkAndSaysSo) {
  for (const char* model : {"uniform", "cie-overcast", "cie:1", "cie:12", "perez:0,0"}) {
    for (const double altitude : {0.0, -5.0, -90.0}) {
      const Sky sky = make_sky(request(model, altitude));
      EXPECT_FALSE(sky.model) << model;
      EXPECT_EQ(sky.sun.normal_illuminance.value(), 0.0);
      EXPECT_TRUE(has_finding(sky, "night"));
    }
  }
  SkyRequest lit = request("uniform", -5.0);
  lit.sky_illuminance = Illuminance(100.0);
  lit.sun_illuminance = Illuminance(50000.0);
  const Sky sky = make_sky(lit);
  EXPECT_TRUE(sky.model);
  EXPECT_EQ(sky.sun.normal_illuminance.value(), 0.0);
}

TEST(MakeSky, SunAtHorizonAndZenithGiveFiniteSkies) {
  for (int type = 1; type <= 15; ++type) {
    for (const double altitude : {1e-6, 0.01, 89.9999, 90.0}) {
      const Sky sky = make_sky(request("cie:" + std::to_string(type), altitude));
      ASSERT_TRUE(sky.model) << type << " " << altitude;
      EXPECT_TRUE(std::isfinite(sky.luminance(kZenith).value()));
      EXPECT_TRUE(std::isfinite(sky.luminance({0.0, 1.0, 0.0}).value()));
    }
  }
}

TEST(MakeSky, PerezClampsAreFindings) {
  EXPECT_TRUE(has_finding(make_sky(request("perez:900,5", 8.0)), "perez_limits"));
  EXPECT_FALSE(has_finding(make_sky(request("perez:300,120", 50.0)), "perez_limits"));
}

TEST(MakeSky, PerezWithoutDiffuseLightHasASunOnly) {
  const Sky sky = make_sky(request("perez:800,0"));
  EXPECT_FALSE(sky.model);
  EXPECT_GT(sky.sun.normal_illuminance.value(), 60000.0);
}

TEST(MakeSky, NoneHasNoSkyButTheSunAskedFor) {
  SkyRequest r = request("none");
  r.sun_illuminance = Illuminance(50000.0);
  const Sky sky = make_sky(r);
  EXPECT_FALSE(sky.model);
  EXPECT_DOUBLE_EQ(sky.sun.normal_illuminance.value(), 50000.0);
  EXPECT_DOUBLE_EQ(sky.sun.angular_radius.in_degrees(), 0.2666);
}

TEST(MakeSky, WrongWordsAreRefusedWithASuggestion) {
  EXPECT_NE(message_of(request("overcast")).find("cie-overcast"), std::string::npos);
  EXPECT_NE(message_of(request("unifrom")).find("'uniform'"), std::string::npos);
  EXPECT_NE(message_of(request("perz:1,2")).find("perez:DNI,DHI"), std::string::npos);
  for (const char* model : {"", "cie:0", "cie:16", "cie:x", "cie:", "cie", "perez:1", "perez:-1,2",
                            "perez:nan,2", "perez:1,2,3", "perez:9999,100", "weather:", "image:",
                            "image:/no/such/file.hdr", "weather:/no/such/file.epw"}) {
    EXPECT_NE(message_of(request(model)), "") << model;
  }
}

TEST(MakeSky, ImpossibleNumbersAreRefused) {
  SkyRequest r = request("uniform");
  for (const double value : {-1.0, std::nan(""), HUGE_VAL}) {
    r.sky_illuminance = Illuminance(value);
    EXPECT_NE(message_of(r), "");
    r.sky_illuminance.reset();
    r.sun_illuminance = Illuminance(value);
    EXPECT_NE(message_of(r), "");
    r.sun_illuminance.reset();
  }
  EXPECT_NE(message_of(request("cie:12", std::nullopt)).find("--sun-altitude"), std::string::npos);
  EXPECT_NE(message_of(request("uniform", std::nullopt)).find("--sky-illuminance"),
            std::string::npos);
}

TEST(ImageSky, EastOfThePictureIsEastAndTurnsClockwise) {
  const auto path = write_picture("east.hdr", 64, 32);
  const Vec3 east{std::cos(0.5), 0.0, std::sin(0.5)}, south{0.0, -std::cos(0.5), std::sin(0.5)};
  SkyRequest r = request("image:" + path.string(), std::nullopt);
  const Sky sky = make_sky(r);
  // pixels of 1 and 2, taken as W/m2 sr with 179 lm/W
  EXPECT_NEAR(sky.luminance(east).value(), 2.0 * 179.0, 0.01 * 179.0);
  EXPECT_NEAR(sky.luminance(south).value(), 179.0, 0.01 * 179.0);
  // a quarter of the sky at twice the rest: pi (1 + 1/4)
  EXPECT_NEAR(sky.horizontal_diffuse_lux, 179.0 * kPi * 1.25, 0.01 * 179.0 * kPi);
  r.image_rotation = Angle::degrees(90.0);
  EXPECT_NEAR(make_sky(r).luminance(south).value(), 2.0 * 179.0, 0.01 * 179.0);
  r.sky_illuminance = Illuminance(5000.0);
  const Sky scaled = make_sky(r);
  EXPECT_NEAR(scaled.horizontal_diffuse_lux, 5000.0, 1e-6);
}

TEST(ImageSky, WrongPicturesAreRefused) {
  const auto square = write_picture("square.hdr", 32, 32);
  EXPECT_NE(message_of(request("image:" + square.string())).find("twice as wide"),
            std::string::npos);
  const auto whole = write_picture("whole.hdr", 64, 32);
  std::filesystem::resize_file(whole, 60);
  EXPECT_NE(message_of(request("image:" + whole.string())), "");
  const auto text = std::filesystem::path(::testing::TempDir()) / "text.hdr";
  std::ofstream(text) << "no picture";
  EXPECT_NE(message_of(request("image:" + text.string())), "");
  std::ofstream(text, std::ios::trunc).close();
  EXPECT_NE(message_of(request("image:" + text.string())), "");
  EXPECT_NE(message_of(request(std::string("image:") + ::testing::TempDir())), "");
}

TEST(ImageSky, NegativePixelsOfARealImageAreCounted) {
  const char* data = std::getenv("TENKU_DATA");
  if (data == nullptr) GTEST_SKIP() << "TENKU_DATA is not set";
  const std::string path = std::string(data) + "/hdr/blender_city.exr";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no hdr/blender_city.exr in TENKU_DATA";
  const Sky sky = make_sky(request("image:" + path));
  ASSERT_TRUE(has_finding(sky, "bad_sky_pixels"));
  EXPECT_GT(sky.diagnostics.front().count, 0u);
  EXPECT_GT(sky.horizontal_diffuse_lux, 0.0);
}

}  // namespace
}  // namespace tenku
