#include <gtest/gtest.h>

#include <memory>

#include "core/error.h"
#include "sky_models/cie_general_sky.h"
#include "sky_models/cie_overcast_sky.h"
#include "sky_models/hemisphere_integral.h"
#include "sky_models/perez_sky.h"
#include "sky_models/uniform_sky.h"
#include "support/measured.h"
#include "support/reference_table.h"

namespace tenku {
namespace {

using testing_support::ReferenceTable;
using testing_support::WorstError;

constexpr int kTraditionalOvercast = 16;

Vec3 direction_deg(double azimuth, double altitude) {
  return direction_from(Angle::degrees(azimuth), Angle::degrees(altitude));
}

std::unique_ptr<SkyModel> cie_sky(int type, Vec3 sun) {
  if (type == kTraditionalOvercast) return std::make_unique<CieOvercastSky>(Luminance(1.0));
  return std::make_unique<CieGeneralSky>(type, sun, Luminance(1.0));
}

// The reference has 12 digits of the exact formula.
TEST(CieSkies, LuminanceIsTheStandards) {
  const ReferenceTable t(TENKU_TEST_REFERENCE "/sky/cie_luminance.csv");
  WorstError error("cie_luminance_relative");
  for (std::size_t i = 0; i < t.size(); ++i) {
    const Vec3 sun = direction_deg(t.number(i, "sun_az_deg"), t.number(i, "sun_alt_deg"));
    const auto sky = cie_sky(static_cast<int>(t.number(i, "sky_type")), sun);
    const double altitude = t.number(i, "alt_deg"), expected = t.number(i, "L_over_Lz");
    const double value = sky->luminance(direction_deg(t.number(i, "az_deg"), altitude)).value();
    error.add(value / expected - 1.0, t.text(i, "sky_type") + " alt " + t.text(i, "alt_deg"));
  }
  EXPECT_LT(error.worst(), 1e-7);
}

// Angles of a tilted plane's azimuth are relative to the sun's, the sun at 180 degrees.
TEST(CieSkies, IlluminancesAreTheReferences) {
  const ReferenceTable t(TENKU_TEST_REFERENCE "/sky/cie_integrals.csv");
  WorstError horizontal("cie_horizontal_relative"), tilted("cie_tilted_relative");
  for (std::size_t i = 0; i < t.size(); ++i) {
    const Vec3 sun = direction_deg(180.0, t.number(i, "sun_alt_deg"));
    const auto sky = cie_sky(static_cast<int>(t.number(i, "sky_type")), sun);
    const double level = horizontal_illuminance(*sky, sun).value(), expected = t.number(i, "value");
    const std::string where = t.text(i, "sky_type") + " sun " + t.text(i, "sun_alt_deg");
    const std::string& quantity = t.text(i, "quantity");
    if (quantity == "Ehd_over_Lz_sr") horizontal.add(level / expected - 1.0, where);
    if (quantity != "E_tilt_over_Ehd_sky_only") continue;
    const Vec3 normal = direction_deg(180.0 + t.number(i, "rel_azimuth_to_sun_deg"),
                                      90.0 - t.number(i, "tilt_deg"));
    tilted.add(plane_illuminance(*sky, sun, normal).value() / level / expected - 1.0,
               where + " tilt " + t.text(i, "tilt_deg"));
  }
  EXPECT_LT(horizontal.worst(), 1e-8);
  EXPECT_LT(tilted.worst(), 1e-5);
}

TEST(PerezSky, StepsAndLuminanceAreTheReferences) {
  const ReferenceTable t(TENKU_TEST_REFERENCE "/sky/perez.csv");
  const ReferenceTable points(TENKU_TEST_REFERENCE "/sky/perez_luminance.csv");
  WorstError steps("perez_steps_relative"), efficacy("perez_efficacy_lm_W"),
      luminance("perez_luminance_relative");
  std::size_t p = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    PerezConditions k;
    k.direct_normal = Irradiance(t.number(i, "dni_W_m2"));
    k.diffuse_horizontal = Irradiance(t.number(i, "dhi_W_m2"));
    k.extraterrestrial = Irradiance(t.number(i, "I0_W_m2"));
    k.dew_point_c = t.number(i, "dew_point_C");
    k.sun = direction_deg(t.number(i, "sun_az_deg"), t.number(i, "sun_alt_deg"));
    const PerezParameters parameters = perez_parameters(k);
    const std::string& id = t.text(i, "case");
    steps.add(parameters.epsilon / t.number(i, "epsilon") - 1.0, id);
    steps.add(parameters.delta / t.number(i, "delta") - 1.0, id);
    EXPECT_EQ(parameters.bin, static_cast<int>(t.number(i, "bin_1to8"))) << id;
    steps.add(parameters.a - t.number(i, "a"), id);
    steps.add(parameters.b - t.number(i, "b"), id);
    steps.add((parameters.c - t.number(i, "c")) / 10.0, id);
    steps.add(parameters.d - t.number(i, "d"), id);
    steps.add(parameters.e - t.number(i, "e"), id);
    efficacy.add(parameters.diffuse_efficacy - t.number(i, "diffuse_efficacy_lm_W"), id);
    efficacy.add(parameters.beam_efficacy - t.number(i, "beam_efficacy_lm_W"), id);
    // in W/m2 sr: scaled to the diffuse irradiance
    const PerezSky sky(parameters, k.sun, Illuminance(k.diffuse_horizontal.value()));
    for (; p < points.size() && points.text(p, "case") == id; ++p) {
      const Vec3 d = direction_deg(points.number(p, "az_deg"), points.number(p, "alt_deg"));
      luminance.add(sky.luminance(d).value() / points.number(p, "L_abs_W_m2_sr") - 1.0, id);
    }
  }
  EXPECT_EQ(p, points.size());
  EXPECT_LT(steps.worst(), 1e-7);
  EXPECT_LT(efficacy.worst(), 1e-5);
  EXPECT_LT(luminance.worst(), 1e-6);
}

}  // namespace
}  // namespace tenku
