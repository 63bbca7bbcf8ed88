// The picture of the Cornell box by its published camera.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "support/cornell_view.h"
#include "support/lamp_paths.h"
#include "support/measured.h"
#include "support/reference_table.h"

namespace tenku {
namespace {

using testing_support::LampPaths;
using testing_support::ReferenceTable;
using testing_support::WorstError;

const std::filesystem::path kFolder = TENKU_SOURCE_DIR "/scenes/verification/cornell_box";
constexpr int kSide = 64;  // pixels, of the reference
constexpr double kTolerance_pct = 1.0;
// Long elements save time; with shorter ones: docs/validation.md.
constexpr double kMeshTolerance_pct = 4.0;
constexpr std::array<const char*, 3> kChannels{"red", "green", "blue"};

std::array<double, 3> channels(Rgb c) { return {c.r, c.g, c.b}; }

struct Reference {
  std::vector<Rgb> light;         ///< [pixel], cd/m2
  std::vector<double> error_pct;  ///< [pixel], standard error
};

Reference reference_picture() {
  const ReferenceTable table(TENKU_TEST_REFERENCE "/radiosity/cornell_picture.csv");
  Reference reference;
  for (std::size_t p = 0; p < table.size(); ++p) {
    reference.light.push_back(
        {table.number(p, "red"), table.number(p, "green"), table.number(p, "blue")});
    reference.error_pct.push_back(table.number(p, "error_pct"));
  }
  return reference;
}

/// Means over the pixels of a rectangle of the 64 x 64, whatever the size of the picture.
Rgb mean_of(const std::vector<Rgb>& pixels, std::array<int, 4> columns_rows) {
  const int side = static_cast<int>(std::lround(std::sqrt(pixels.size())));
  for (int& x : columns_rows) x = x * side / kSide;
  const auto [left, right, top, bottom] = columns_rows;
  Rgb sum{};
  for (int row = top; row < bottom; ++row) {
    for (int column = left; column < right; ++column) {
      sum = sum + pixels[static_cast<std::size_t>(row * side + column)];
    }
  }
  return (1.0 / ((right - left) * (bottom - top))) * sum;
}

// The reference is our own; this is by others.
TEST(CornellPicture, PathsOfItsReferenceFindThePublishedIrradiances) {
  const ReferenceTable table(TENKU_TEST_REFERENCE "/radiosity/cornell_irradiance.csv");
  const LitScene lit = testing_support::cornell_box(kFolder);
  const LampPaths paths(lit.rays());
  WorstError worst("paths in the Cornell box, beyond 4 standard errors, percent");
  constexpr int kScrambles = 16;
  for (std::size_t row = 0; row < table.size(); ++row) {
    if (table.text(row, "scene") != "with_blocks") continue;
    const auto vector = [&](const std::string& prefix) {
      return Vec3{-table.number(row, prefix + "x"), table.number(row, prefix + "z"),
                  table.number(row, prefix + "y")};
    };
    std::array<std::array<double, 3>, kScrambles> found{};
    for (std::size_t s = 0; s < kScrambles; ++s) {
      found[s] = channels(paths.illuminance(0.001 * vector(""), vector("n"), mix_bits(s), 512));
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const std::string name = std::string(1, "RGB"[c]);
      const double expected = table.number(row, "E_" + name);
      double mean = 0.0, squares = 0.0;
      for (const auto& one : found) mean += one[c] / kScrambles;
      for (const auto& one : found) squares += std::pow(one[c] - mean, 2);
      const double noise = std::hypot(std::sqrt(squares / (kScrambles * (kScrambles - 1.0))),
                                      table.number(row, "stderr_" + name));
      worst.add(100.0 * std::max(0.0, std::abs(mean - expected) - 4.0 * noise) / expected,
                std::to_string(row) + name);
    }
  }
  EXPECT_LE(worst.worst(), 0.3);
}

TEST(CornellPicture, ByRadiosityIsThatOfPaths) {
  const Reference reference = reference_picture();
  const LitScene lit = testing_support::cornell_box(kFolder);
  const RenderedView view =
      testing_support::cornell_by_radiosity(lit, kSide, kTolerance_pct, kMeshTolerance_pct);
  ASSERT_EQ(view.luminance.pixels.size(), reference.light.size());
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0.0, truth = 0.0, squares = 0.0;
    std::size_t outside = 0, seen = 0;
    for (std::size_t p = 0; p < reference.light.size(); ++p) {
      const double found = channels(view.luminance.pixels[p])[c];
      const double expected = channels(reference.light[p])[c];
      if (!(expected > 0.0)) {
        EXPECT_EQ(found, 0.0) << p;
        continue;
      }
      const double off = found / expected - 1.0;
      ++seen, sum += found, truth += expected, squares += off * off;
      outside += std::abs(off) > 0.02 + 0.03 * reference.error_pct[p];
    }
    const double outside_pct = 100.0 * static_cast<double>(outside) / static_cast<double>(seen);
    std::printf(
        "[ MEASURED ] Cornell box, picture, %s: mean %+.2f %%, root mean square %.2f %%, outside "
        "2 %% and noise %.2f %% of %zu pixels\n",
        kChannels[c], 100.0 * (sum / truth - 1.0),
        100.0 * std::sqrt(squares / static_cast<double>(seen)), outside_pct, seen);
    EXPECT_NEAR(sum / truth, 1.0, 0.005) << kChannels[c];
    EXPECT_LE(outside, 2U) << kChannels[c];
  }
}

// Where its neighbours agree, a pixel is like them: at the feet of the blocks too, where points
// that stood for others used to lie in the shadow.
TEST(CornellPicture, HasNoSpecks) {
  constexpr int kWide = 160;
  const LitScene lit = testing_support::cornell_box(kFolder);
  const RenderedView view = testing_support::cornell_by_radiosity(lit, kWide, 5.0, 20.0);
  std::size_t specks = 0, smooth = 0;
  for (int row = 1; row + 1 < kWide; ++row) {
    for (int column = 1; column + 1 < kWide; ++column) {
      std::vector<double> around;
      for (int k = 0; k < 9; ++k) {
        if (k == 4) continue;
        around.push_back(luminance_of(view.luminance.at(column + k % 3 - 1, row + k / 3 - 1)));
      }
      std::sort(around.begin(), around.end());
      // But for one at either end, which may be another speck.
      if (!(around[1] > 0.0) || around[6] > 1.06 * around[1]) continue;
      ++smooth;
      specks += std::abs(luminance_of(view.luminance.at(column, row)) / around[4] - 1.0) > 0.1;
    }
  }
  EXPECT_EQ(specks, 0U);
  EXPECT_GT(smooth, std::size_t{kWide} * kWide / 4);
}

// Light straight from the lamp is found pixel by pixel; what is reflected is blended over blocks.
TEST(CornellPicture, ByPathsHasTheSameLightAndColours) {
  const Reference reference = reference_picture();
  const LitScene lit = testing_support::cornell_box(kFolder);
  ViewRequest request;
  request.view = testing_support::cornell_view(kSide);
  request.tolerance_pct = 5.0;
  request.bounces = 12;
  Progress quiet;
  const RenderedView view = render_view(request, lit.engines(), lit.source(), nullptr, quiet);
  // Red wall, green wall, back wall beside the blocks.
  for (const std::array<int, 4>& at :
       {std::array{2, 12, 16, 40}, std::array{54, 62, 16, 40}, std::array{34, 50, 16, 36}}) {
    const auto found = channels(mean_of(view.luminance.pixels, at));
    const auto expected = channels(mean_of(reference.light, at));
    std::printf("[ MEASURED ] by paths, green over the reference: %.3f\n", found[1] / expected[1]);
    EXPECT_NEAR(found[1] / expected[1], 1.0, 0.05) << at[0];
    for (const std::size_t c : {0, 2}) {
      EXPECT_NEAR(found[c] / found[1] / (expected[c] / expected[1]), 1.0, 0.1)
          << at[0] << " " << kChannels[c];
    }
  }
}

// The red wall is on the left, the green one on the right, and what is white beside them takes
// their colour: ceiling, floor, and the flanks of the blocks.
TEST(CornellPicture, WallsColourWhatIsBesideThem) {
  const Reference reference = reference_picture();
  const LitScene lit = testing_support::cornell_box(kFolder);
  const RenderedView view = testing_support::cornell_by_radiosity(lit, kSide / 2, 5.0, 20.0);
  struct Beside {
    const char* what;
    std::array<int, 4> near_red, near_green;
  };
  const std::array<Beside, 2> places{
      {{"ceiling", {6, 12, 2, 6}, {52, 58, 2, 6}}, {"floor", {6, 12, 58, 62}, {52, 58, 58, 62}}}};
  const auto redness = [](Rgb c) { return c.r / c.g; };
  for (const Beside& place : places) {
    for (const auto& at : {place.near_red, place.near_green}) {
      const double expected = redness(mean_of(reference.light, at));
      EXPECT_NEAR(redness(mean_of(view.luminance.pixels, at)) / expected, 1.0, 0.02) << place.what;
    }
    EXPECT_GT(redness(mean_of(view.luminance.pixels, place.near_red)),
              1.2 * redness(mean_of(view.luminance.pixels, place.near_green)))
        << place.what;
  }
}

}  // namespace
}  // namespace tenku
