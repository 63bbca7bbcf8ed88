// Size fields: what samples ask for is met, smooth between them, and nowhere rises too fast.
#include "meshing/size_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/error.h"
#include "meshing/plane_shapes.h"

namespace tenku::testing_support {
namespace {

/// Samples `step` apart over the box from 0 to `side`.
std::vector<SizeSample> sampled(double side, double step,
                                const std::function<double(PlanePoint)>& size) {
  std::vector<SizeSample> samples;
  const int n = static_cast<int>(std::round(side / step));
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const PlanePoint p{side * i / n, side * j / n};
      samples.push_back({p, size(p)});
    }
  }
  return samples;
}

constexpr SizeFieldOptions kWide{.least_m = 1e-3, .most_m = 100.0, .grading = 10.0};

TEST(SizeField, EqualSamplesGiveThatSizeWithoutAGrid) {
  const auto samples = sampled(4.0, 1.0, [](PlanePoint) { return 0.3; });
  const SizeField field(rectangle(4.0, 4.0), samples, kWide);
  EXPECT_EQ(field.at({1.234, 3.21}), 0.3);
  EXPECT_EQ(field.nodes(), 0U);
}

TEST(SizeField, WithoutSamplesTheSizeIsTheGreatest) {
  const SizeField field(rectangle(4.0, 4.0), {}, {.least_m = 0.1, .most_m = 0.7});
  EXPECT_EQ(field.at({1.0, 1.0}), 0.7);
}

TEST(SizeField, ExponentialSizeNeedsNoBending) {
  // The logarithm is a plane, of no energy: three samples say it all.
  const auto size = [](PlanePoint p) { return std::exp(0.2 * p.x - 0.1 * p.y - 1.0); };
  std::vector<SizeSample> samples;
  for (const PlanePoint p : {PlanePoint{0, 0}, PlanePoint{4, 1}, PlanePoint{1, 4}}) {
    samples.push_back({p, size(p)});
  }
  const SizeField field(rectangle(4.0, 4.0), samples, kWide);
  // Between nodes the size is a chord of the exponential, off by (k h)^2 / 8 along each axis; the
  // slope costs a millionth of bending, and samples are not held without give.
  const double chord = (0.2 * 0.2 + 0.1 * 0.1) * field.spacing_m() * field.spacing_m() / 8.0;
  for (const PlanePoint p : {PlanePoint{1, 1}, PlanePoint{2, 1.5}, PlanePoint{1.3, 2.2}}) {
    EXPECT_NEAR(field.at(p) / size(p), 1.0, chord + 5e-4);
  }
}

TEST(SizeField, PlateOverFourLinesIsTheCubicOfABeam) {
  // The logarithm is 0, 1, 1, 0 at x = 0, 1, 2, 3. A beam over four supports has, by the equation
  // of three moments, 4 M1 + M2 = -6 and M1 = M2 = -1.2 there, so that it passes x = 0.5 at 0.5 -
  // M1 / 16 = 0.575.
  std::vector<SizeSample> samples;
  for (int j = 0; j <= 300; ++j) {
    for (const double x : {0.0, 1.0, 2.0, 3.0}) {
      samples.push_back({{x, 0.01 * j}, 0.05 * (x == 1.0 || x == 2.0 ? std::exp(1.0) : 1.0)});
    }
  }
  const SizeField field(rectangle(3.0, 3.0), samples, kWide);
  // A grid of 0.13 m sees the supports as wide as its cells.
  EXPECT_NEAR(std::log(field.at({0.5, 1.5}) / 0.05), 0.575, 0.02);
  EXPECT_NEAR(std::log(field.at({2.5, 1.5}) / 0.05), 0.575, 0.02);
}

TEST(SizeField, NeverRisesFasterThanGrading) {
  const auto step = [](PlanePoint p) { return p.x < 2.0 ? 0.05 : 1.0; };
  const SizeFieldOptions options{.least_m = 0.01, .most_m = 2.0, .grading = 0.2};
  const SizeField field(rectangle(4.0, 4.0), sampled(4.0, 0.1, step), options);
  EXPECT_NEAR(field.at({1.0, 2.0}), 0.05, 1e-3);
  // The last small sample is at 1.9, and up to a cell from a node.
  EXPECT_LE(field.at({4.0, 2.0}), 0.05 + 0.2 * (2.1 + field.spacing_m()));
  EXPECT_GE(field.at({4.0, 2.0}), 0.05 + 0.2 * 1.8);
  for (double x = 0.0; x < 3.9; x += 0.037) {
    for (const double y : {0.3, 1.7, 3.1}) {
      const double rise = field.at({x + 0.05, y + 0.05}) - field.at({x, y});
      // Along a slant of the grid steps are counted on its edges: 8 % more at most.
      EXPECT_LE(std::abs(rise), 1.09 * 0.2 * std::hypot(0.05, 0.05));
    }
  }
}

TEST(SizeField, OneSmallSampleAmongManyIsNotLost) {
  auto samples = sampled(4.0, 0.1, [](PlanePoint) { return 0.5; });
  samples.push_back({{2.03, 1.17}, 0.02});
  const SizeField field(rectangle(4.0, 4.0), samples,
                        {.least_m = 0.01, .most_m = 1.0, .grading = 0.25});
  // Within a cell of the grid.
  EXPECT_LE(field.at({2.03, 1.17}), 0.02 + 0.25 * field.spacing_m());
  EXPECT_GE(field.at({0.5, 3.5}), 0.45);
}

TEST(SizeField, KeepsWithinTheBounds) {
  const auto wild = [](PlanePoint p) { return 0.001 + 3.0 * std::abs(std::sin(5.0 * p.x * p.y)); };
  const SizeField field(rectangle(4.0, 4.0), sampled(4.0, 0.25, wild),
                        {.least_m = 0.1, .most_m = 0.4});
  for (double x = -1.0; x < 5.0; x += 0.13) {
    for (double y = -1.0; y < 5.0; y += 0.17) {
      EXPECT_GE(field.at({x, y}), 0.1 * (1.0 - 1e-12));
      EXPECT_LE(field.at({x, y}), 0.4 * (1.0 + 1e-12));
    }
  }
}

TEST(SizeField, NodesAreNoMoreThanTheSamplesTell) {
  const auto size = [](PlanePoint p) { return 0.01 + 0.001 * p.x; };
  EXPECT_LE(SizeField(rectangle(40.0, 40.0), sampled(40.0, 10.0, size), kWide).nodes(), 64U);
  EXPECT_LE(SizeField(rectangle(4.0, 4.0), sampled(4.0, 0.1, size), kWide).nodes(), 841U);
  EXPECT_LE(SizeField(rectangle(4.0, 4.0), sampled(4.0, 0.025, size), kWide).nodes(), 4096U);
}

TEST(SizeField, RefusesWhatIsNoSize) {
  const FlatPolygon square = rectangle(1.0, 1.0);
  const std::vector<SizeSample> bad{{{0.5, 0.5}, 0.0}}, lost{{{0.5, std::nan("")}, 1.0}};
  EXPECT_THROW(SizeField(square, bad, kWide), InputError);
  EXPECT_THROW(SizeField(square, lost, kWide), InputError);
  EXPECT_THROW(SizeField(square, {}, {.least_m = 2.0, .most_m = 1.0}), InputError);
  EXPECT_THROW(SizeField(square, {}, {.least_m = 0.1, .most_m = 1.0, .grading = 0.0}), InputError);
}

}  // namespace
}  // namespace tenku::testing_support
