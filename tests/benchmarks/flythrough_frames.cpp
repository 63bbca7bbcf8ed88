// Frames of a point store beside the same frames rendered directly: how alike, how long either
// takes, and by how much more the stored ones change from a frame to the next.
// flythrough_frames STORE SCENE SKY SUN_ALTITUDE SUN_AZIMUTH TOLERANCE BOUNCES COUNT [OUT] [GROUND]
// [LIGHTING]. One row a frame; with OUT (not -), pairs of PNG files.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string>

#include "core/stopwatch.h"
#include "flythrough/played_frame.h"
#include "output/image_writer.h"
#include "study/lit_scene.h"
#include "view/picture_difference.h"
#include "view/tone_map.h"
#include "view/view_render.h"

namespace tenku {
namespace {

using testing_support::PlayedFrame;

double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

int compare(char** argv, int argc) {
  const PointStore store{argv[1]};
  SkyRequest sky;
  sky.model = argv[3];
  sky.sun = SunInSky{
      direction_from(Angle::degrees(std::atof(argv[5])), Angle::degrees(std::atof(argv[4]))),
      Angle::degrees(0.533 / 2), std::nullopt};
  ReadOptions read;
  if (argc > 10) read.ground = GroundChoice::parse(argv[10]);
  Progress quiet;
  const LitScene lit(
      argv[2], read, [&](const auto&) { return make_sky(sky); }, std::nullopt, GlPlatform::Auto,
      quiet);
  ViewRequest request;
  request.tolerance_pct = std::atof(argv[6]);
  request.bounces = std::atoi(argv[7]);
  const auto count = static_cast<std::size_t>(std::atoi(argv[8]));
  const std::string out = argc > 9 ? argv[9] : "-";
  const std::size_t lighting = argc > 11 ? static_cast<std::size_t>(std::atoi(argv[11])) : 0;
  const std::size_t n = store.header().path.size();
  fmt::print(
      "frame,difference,similarity,step_beyond_direct,direct_s,direct_processor_s,played_s,"
      "empty_share\n");
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t frame = count > 1 ? k * (n - 1) / (count - 1) : n / 2;
    const auto render = [&](std::size_t f) {
      request.view = store.header().path.view(f);
      return render_view(request, lit.engines(), lit.source(), lit.sky().model.get(), quiet);
    };
    Stopwatch clock;
    const double before = processor_s();
    const RenderedView direct = render(frame);
    const double direct_s = clock.seconds(), direct_cpu = processor_s() - before;
    clock = {};
    const PlayedFrame played = testing_support::played_frame(store, frame, lighting);
    const double played_s = clock.seconds();
    // One exposure for all.
    ToneMapOptions tone;
    tone.ev100 = std::log2(1.0 / (1.2 * exposure_of(direct.luminance, {})));
    const Image8 a = tone_map(direct.luminance, tone), b = tone_map(played.luminance, tone);
    double step = 0.0;
    if (n > 1) {
      const std::size_t next = frame + 1 < n ? frame + 1 : frame - 1;
      const Image8 c = tone_map(render(next).luminance, tone),
                   d = tone_map(testing_support::played_frame(store, next, lighting).luminance,
                                tone);
      step = mean_difference(b, d) - mean_difference(a, c);
    }
    fmt::print("{},{:.3f},{:.4f},{:.3f},{:.2f},{:.2f},{:.2f},{:.4f}\n", frame,
               mean_difference(a, b), structural_similarity(a, b), step, direct_s, direct_cpu,
               played_s, static_cast<double>(played.empty_samples) / (4.0 * a.width * a.height));
    if (out == "-") continue;
    write_png(fmt::format("{}/direct{:04}.png", out, frame), a);
    write_png(fmt::format("{}/played{:04}.png", out, frame), b);
  }
  return 0;
}

}  // namespace
}  // namespace tenku

int main(int argc, char** argv) {
  if (argc < 9) {
    fmt::print(stderr,
               "flythrough_frames STORE SCENE SKY SUN_ALTITUDE SUN_AZIMUTH TOLERANCE BOUNCES COUNT "
               "[OUT] [GROUND] [LIGHTING]\n");
    return 2;
  }
  return tenku::compare(argv, argc);
}
