// Mirrors in pictures by beams beside single rays: how they differ, how often they ask the scene,
// and how long they take, 1024 x 1024 pixels and four rays in each.
//
//   mirror_benchmark [FOLDER_FOR_PICTURES]        the scenes of docs/reflections.md
//   mirror_benchmark --cuboids                    how the ratios fall with the number of mirrors,
//   CSV
//
// Times are medians of five, processor time of all threads and the clock, of the stages "beams"
// and "view rays".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <functional>
#include <iostream>

#include "output/image_writer.h"
#include "support/mirror_pictures.h"
#include "view/shading_points.h"
#include "view/tone_map.h"

namespace tenku::testing_support {
namespace {

/// Median of five, seconds.
struct Seconds {
  double processor, clock;
};

Seconds median_time(const std::function<void()>& work) {
  std::array<double, 5> processor{}, clock{};
  for (std::size_t k = 0; k < clock.size(); ++k) {
    const std::clock_t from = std::clock();
    const auto start = std::chrono::steady_clock::now();
    work();
    clock[k] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    processor[k] = static_cast<double>(std::clock() - from) / CLOCKS_PER_SEC;
  }
  std::sort(processor.begin(), processor.end());
  std::sort(clock.begin(), clock.end());
  return {processor[2], clock[2]};
}

/// A way of following, timed.
struct Followed {
  TracedPicture picture;
  MirrorReport report;
  std::uint64_t queries = 0;
  Seconds seconds{};
};

class Run {
 public:
  explicit Run(const MirrorPicture& picture)
      : picture_(picture),
        rays_(picture.scene.soup, picture.scene.materials),
        camera_(picture.view),
        backdrop_{nullptr, {}, &surroundings_} {}

  Followed followed(MirrorMethod method) {
    Followed made;
    Progress progress;
    const auto paths = [&](MirrorReport& report) {
      return pixel_paths(camera_, rays_, backdrop_, {method, picture_.depth, false}, progress,
                         report);
    };
    made.seconds = median_time([&] {
      MirrorReport report;
      made.queries =
          find_shading_points(camera_, rays_, *paths(report), PointPlace::First, progress).rays;
    });
    made.picture = trace_picture(*paths(made.report), rays_, picture_.view);
    made.queries += made.report.queries;
    return made;
  }

 private:
  const MirrorPicture& picture_;
  CheckeredCube surroundings_;
  RayVisibility rays_;
  PerspectiveCamera camera_;
  Backdrop backdrop_;
};

std::string name_of(MirrorMethod used) { return used == MirrorMethod::Beams ? "beams" : "rays"; }

void measure(const MirrorPicture& picture, const std::string& folder) {
  Run run(picture);
  const Followed beams = run.followed(MirrorMethod::Beams), rays = run.followed(MirrorMethod::Rays);
  MirrorReport chosen;
  const double gain = rays.seconds.processor / beams.seconds.processor;
  const Followed any = run.followed(MirrorMethod::Auto);
  const PictureDifference off = difference(beams.picture, rays.picture);
  fmt::print(
      "{:28} {:6} {:8} {:10} {:10} {:8.1f} {:7.3f} {:7.3f} {:7.3f} {:7.3f} {:6.2f} {:5} "
      "{:8.2g} {:8.4f} {:6.2f}\n",
      picture.name, beams.report.mirrors, beams.report.regions, beams.queries, rays.queries,
      static_cast<double>(rays.queries) / static_cast<double>(beams.queries),
      beams.seconds.processor, rays.seconds.processor, beams.seconds.clock, rays.seconds.clock,
      gain, name_of(any.report.used), off.away_from_edge, 100.0 * off.differing,
      100.0 * off.edge_share);
  std::cout.flush();
  if (folder.empty()) return;
  std::string file = picture.name;
  std::replace(file.begin(), file.end(), ' ', '_');
  const ToneMapOptions how{.curve = ToneCurve::Reinhard, .ev100 = {}, .key = 0.4};
  write_png(folder + "/" + file + ".png", tone_map(beams.picture.image, how), {});
}

}  // namespace
}  // namespace tenku::testing_support

int main(int count, char** words) {
  using namespace tenku::testing_support;
  const std::string word = count > 1 ? words[1] : "";
  fmt::print(
      "{:28} {:>6} {:>8} {:>10} {:>10} {:>8} {:>7} {:>7} {:>7} {:>7} {:>6} {:>5} {:>8} {:>8} "
      "{:>6}\n",
      "scene", "mirror", "regions", "queries_b", "queries_r", "ratio", "cpu_b", "cpu_r", "clock_b",
      "clock_r", "gain", "auto", "away", "differ_%", "edge_%");
  if (word == "--cuboids") {
    for (const int n : {1, 2, 4, 8, 16, 33, 66, 130, 260}) measure(scattered_cuboids(n), "");
    return 0;
  }
  for (const MirrorPicture& picture : mirror_pictures()) measure(picture, word);
  return 0;
}
