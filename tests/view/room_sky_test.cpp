// Skylight in pictures of a room that sees the sky through a window, sideways.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "study/lit_scene.h"
#include "study/scene_reflection.h"
#include "view/view_render.h"

namespace tenku {
namespace {

RenderedView picture(const LitScene& lit, std::uint64_t seed) {
  SceneReflection reflection(lit, Reflection::Radiosity);
  ViewRequest request;
  // Along the wall with the window, which its neighbours see at a grazing angle.
  request.view = {{1.0, 1.0, 1.6}, {4.0, 2.0, 1.0}, Angle::degrees(60.0), 128, 128};
  request.seed = seed;
  IlluminanceOptions options;
  options.tolerance_pct = 10.0;
  options.seed = seed;
  request.reflection = reflection.finder(options, request.method);
  Progress quiet;
  return render_view(request, lit.engines(), lit.source(), lit.sky().model.get(), quiet);
}

// Two pictures by random numbers of their own tell how far either is off by chance.
TEST(PictureOfARoom, HasNoNoiseWhereTheWindowIsSeenSideways) {
  SkyRequest sky;
  sky.model = "cie-overcast";
  sky.sky_illuminance = Illuminance(10000.0);
  Progress quiet;
  const LitScene lit(
      TENKU_TEST_REFERENCE "/radiosity/side_lit_room.obj", {},
      [&](const auto&) { return make_sky(sky); }, {}, {}, quiet);
  const RenderedView one = picture(lit, 1), other = picture(lit, 2);
  double squares = 0.0;
  std::size_t outside = 0, seen = 0;
  for (std::size_t p = 0; p < one.luminance.pixels.size(); ++p) {
    const double a = luminance_of(one.luminance.pixels[p]),
                 b = luminance_of(other.luminance.pixels[p]);
    const double off = (a - b) / (a + b) * std::sqrt(2.0);  // of the mean: of one by chance
    ++seen, squares += off * off, outside += std::abs(off) > 0.05;
  }
  const double rms_pct = 100.0 * std::sqrt(squares / static_cast<double>(seen));
  const double outside_pct = 100.0 * static_cast<double>(outside) / static_cast<double>(seen);
  std::printf(
      "[ MEASURED ] noise of a picture of a room: %.2f %%, beyond 5 %%: %.2f %% of %zu pixels\n",
      rms_pct, outside_pct, seen);
  EXPECT_LE(rms_pct, 2.0);
  EXPECT_LE(outside_pct, 1.25);  // of the normal distribution: 1.2
}

}  // namespace
}  // namespace tenku
