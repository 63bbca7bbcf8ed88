// Skylight summed over the elements of a partition, against values from outside.
#include <gtest/gtest.h>

#include <cstdio>

#include "support/measured.h"
#include "verification/reference_cases.h"

namespace tenku {
namespace {

using testing_support::Coverage;
using testing_support::ReferenceCase;
using testing_support::ReferenceTable;
using testing_support::TestScene;
using testing_support::WorstError;

/// The source of a numbered sky, in elements.
struct ElementSource {
  std::unique_ptr<SkyModel> sky;
  DaylightSource source;

  ElementSource(int type, double sun_altitude_deg, const PartitionRequest& partition)
      : sky(testing_support::numbered_sky(type, sun_altitude_deg, 180.0)),
        source(testing_support::source_of(*sky)) {
    source.elements = std::make_unique<ElementSky>(*sky, partition_sky(*sky, partition));
  }
};

PartitionRequest partition(const std::string& method, std::size_t elements = 0) {
  PartitionRequest request = parse_partition(method);
  if (elements > 0) request.elements = elements;
  return request;
}

std::vector<PartitionRequest> some_partitions() {
  return {partition("adaptive", 1),  partition("adaptive", 300), partition("energy", 64),
          partition("uniform", 256), partition("tregenza"),      partition("reinhart:2")};
}

/// A pavement, and one sensor above it.
IlluminanceResult in_the_open(const DaylightSource& source, Vec3 normal) {
  TestScene scene;
  scene.level({-50, -50, 50, 50}, 0.0);
  Sensors sensors;
  sensors.position = {{0, 0, 1}};
  sensors.normal = {normalized(normal)};
  return illuminate(scene, sensors, source, testing_support::direct_options(2.0));
}

TEST(ElementSky, UnobstructedHorizontalSensorReceivesTheWholeSky) {
  const ReferenceTable table(TENKU_TEST_REFERENCE "/sky/cie_integrals.csv");
  WorstError worst("open horizontal sensor, sky in elements, relative to the integral");
  for (std::size_t row = 0; row < table.size(); ++row) {
    const double altitude = table.number(row, "sun_alt_deg");
    if (table.text(row, "quantity") != "Ehd_over_Lz_sr" || altitude != 50.0) continue;
    const int type = static_cast<int>(table.number(row, "sky_type"));
    for (const PartitionRequest& request : some_partitions()) {
      const ElementSource sky(type, altitude, request);
      const auto result = in_the_open(sky.source, kZenith);
      const double truth = 3000.0 * table.number(row, "value");
      worst.add(result.values.sky_lux[0] / truth - 1.0, std::to_string(type));
      EXPECT_NEAR(result.values.sky_view[0], 1.0, 1e-12);
      EXPECT_LE(result.values.error_lux[0], truth);
    }
  }
  EXPECT_LE(worst.worst(), 1e-6);
}

// A uniform sky gives a tilted plane pi L (1 + cos tilt) / 2.
TEST(ElementSky, TiltedSensorsReceiveTheClosedFormWithinTheirInterval) {
  WorstError worst("open tilted sensors under a uniform sky of 512 elements, relative");
  const ElementSource sky(5, 40.0, partition("uniform", 512));
  for (const double tilt_deg : {30.0, 90.0, 135.0}) {
    const double tilt = tilt_deg * kPi / 180.0;
    const double share = 0.5 * (1.0 + std::cos(tilt));
    const auto result = in_the_open(sky.source, {std::sin(tilt), 0.0, std::cos(tilt)});
    const double lux = result.values.sky_lux[0];
    worst.add(lux / (3000.0 * kPi * share) - 1.0, std::to_string(tilt_deg));
    EXPECT_LE(std::abs(lux - 3000.0 * kPi * share), 2.0 * result.values.error_lux[0]);
    EXPECT_NEAR(result.values.sky_view[0], share, 0.01);
  }
  EXPECT_LE(worst.worst(), 0.01);
}

/// The reference cases with their skies in elements. The reference has nine digits or more; the
/// ends of what is endless there add less than 1e-4.
void measure(const PartitionRequest& request, const std::string& name) {
  Coverage coverage;
  std::uint64_t number = 0;
  double error_sum = 0.0, error_squares = 0.0, interval_squares = 0.0;
  for (const ReferenceCase& one : testing_support::obstructed_cases()) {
    const int type = std::stoi(one.name.substr(one.name.rfind(' ') + 1));
    const ElementSource sky(type, 40.0, request);
    const double open = one.source->unobstructed_lux();
    ++number;
    for (std::uint64_t seed = 100 * number; seed < 100 * number + 20; ++seed) {
      const auto result = illuminate(*one.scene, one.sensors, sky.source,
                                     testing_support::direct_options(2.0, seed));
      for (std::size_t i = 0; i < one.ratio.size(); ++i) {
        const double error = result.values.total_lux(i) / open - one.ratio[i];
        coverage.add(error, 0.0, result.values.error_lux[i] / open);
        error_sum += error;
        error_squares += error * error;
        interval_squares += std::pow(result.values.error_lux[i] / open, 2);
      }
    }
  }
  const auto n = static_cast<double>(coverage.count());
  const double mean = error_sum / n, rms = std::sqrt(error_squares / n);
  std::printf(
      "[ MEASURED ] sky in elements, %s: rms %.3g, mean %.2g of the open sky; rms interval %.3g; "
      "holds %.1f %% of %zu\n",
      name.c_str(), rms, mean, std::sqrt(interval_squares / n), coverage.pct(), coverage.count());
  EXPECT_GE(coverage.pct(), 93.0) << name;
  EXPECT_LE(coverage.pct(), 99.0) << name;
  // Unbiased: the mean lies within four of its standard errors and the ends of the streets.
  EXPECT_LE(std::abs(mean), 4.0 * rms / std::sqrt(n) + 1e-4) << name;
}

TEST(ElementSky, IntervalHoldsTheClosedFormsOfStreetsCourtsAndBlocks) {
  measure(partition("tregenza"), "tregenza");
  measure(partition("adaptive", 512), "adaptive 512");
  measure(partition("uniform", 2048), "uniform 2048");
}

TEST(ElementSky, SensorsBeyondTheToleranceAreCountedWhateverTheCountOfElements) {
  TestScene scene;
  scene.wall({-50, 3, 50, 3}, 0, 3);
  Sensors sensors;
  sensors.position = {{0, 0, 0}};
  sensors.normal = {kZenith};
  const ElementSource few(16, 40.0, partition("uniform", 16));
  const auto coarse = illuminate(scene, sensors, few.source, testing_support::direct_options(0.5));
  EXPECT_EQ(coarse.out_of_tolerance, 1u);
  EXPECT_GT(coarse.values.error_lux[0], 0.005 * coarse.values.total_lux(0));
  EXPECT_EQ(coarse.rays, 32u) << "two directions an element";
  const auto wide = illuminate(scene, sensors, few.source, testing_support::direct_options(100.0));
  EXPECT_EQ(wide.out_of_tolerance, 0u);
  EXPECT_EQ(wide.values.sky_lux, coarse.values.sky_lux);
}

}  // namespace
}  // namespace tenku
