// Skylight under many things that float: each hides what its closed form says.
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "support/measured.h"
#include "support/test_scene.h"

namespace tenku {
namespace {

using namespace testing_support;

/// Share of a uniform sky that a level rectangle hides from a level sensor `height` below it, one
/// corner straight above.
/// Source   J. R. Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", B-3.
double corner_factor(double a, double b, double height) {
  const double x = a / height, y = b / height, p = std::hypot(1.0, x), q = std::hypot(1.0, y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2.0 * kPi);
}

struct Plate {
  double x0, y0, x1, y1, height;
  double hidden_from(double x, double y) const {
    const auto corner = [&](double px, double py) {
      const double a = px - x, b = py - y;
      return std::copysign(1.0, a) * std::copysign(1.0, b) *
             corner_factor(std::abs(a), std::abs(b), height);
    };
    return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
  }
};

constexpr double kHeight = 6.0;

/// Plates in one plane, which do not overlap: one in some of the squares of a grid.
std::vector<Plate> random_plates(double pitch, double least, double most) {
  SampleRandom random(3, 0, 0);
  std::vector<Plate> plates;
  for (int i = -6; i < 6; ++i) {
    for (int j = -6; j < 6; ++j) {
      if (random.uniform() < 0.4) continue;
      const double side = least + (most - least) * random.uniform();
      const double x = pitch * i + (pitch - side) * random.uniform();
      const double y = pitch * j + (pitch - side) * random.uniform();
      plates.push_back({x, y, x + side, y + side, kHeight});
    }
  }
  return plates;
}

void expect_right(const std::vector<Plate>& plates, double tolerance_pct, const char* name) {
  TestScene scene;
  scene.level({-500, -500, 500, 500}, 0.0);
  for (const Plate& p : plates) {
    scene.begin_object();
    scene.quad({p.x0, p.y0, p.height}, {p.x1, p.y0, p.height}, {p.x1, p.y1, p.height},
               {p.x0, p.y1, p.height});
  }
  Sensors sensors;
  SampleRandom random(4, 0, 0);
  for (int k = 0; k < 150; ++k) {
    sensors.position.push_back(
        {60.0 * (random.uniform() - 0.5), 60.0 * (random.uniform() - 0.5), 0.0});
    sensors.normal.push_back(kZenith);
  }
  const UniformSky sky(Luminance(1000.0));
  const DaylightSource source = source_of(sky);
  const IlluminanceResult result =
      illuminate(scene, sensors, source, direct_options(tolerance_pct));
  Coverage coverage;
  WorstError worst(std::string(name) + ", percent");
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    double open = 1.0;
    for (const Plate& p : plates) {
      open -= p.hidden_from(sensors.position[s].x, sensors.position[s].y);
    }
    const double truth = open * 1000.0 * kPi;
    const double value = result.values.total_lux(s);
    coverage.add(value, truth, result.values.error_lux[s]);
    worst.add(100.0 * (value - truth) / truth, std::to_string(s));
    EXPECT_NEAR(value, truth, 0.01 * tolerance_pct * truth) << name << ", sensor " << s;
  }
  std::printf("[ MEASURED ] %s: %.1f %% inside their intervals, %.0f rays a sensor\n", name,
              coverage.pct(), static_cast<double>(result.rays) / 150.0);
  EXPECT_GE(coverage.pct(), 91.5);  // 95 % less twice the scatter of 150 values
}

TEST(FloatingLight, ManyPlatesHideWhatTheirClosedFormsSay) {
  const std::vector<Plate> plates = random_plates(6.0, 0.5, 3.0);
  expect_right(plates, 2.0, "plates of 0.5 to 3 m, tolerance 2");
  expect_right(plates, 0.5, "plates of 0.5 to 3 m, tolerance 0.5");
}

TEST(FloatingLight, FewLargePlatesHideWhatTheirClosedFormsSay) {
  const std::vector<Plate> plates = random_plates(12.0, 4.0, 10.0);
  expect_right(plates, 2.0, "plates of 4 to 10 m, tolerance 2");
  expect_right(plates, 0.5, "plates of 4 to 10 m, tolerance 0.5");
}

}  // namespace
}  // namespace tenku
