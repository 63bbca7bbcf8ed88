// Mirrors in pictures by beams beside single rays: how they differ, how often they ask the scene,
// and how long they take, 1024 x 1024 pixels and four rays in each.
//
//   mirror_benchmark [FOLDER_FOR_PICTURES]        the scenes of docs/reflections.md
//   mirror_benchmark --paper                      the first of them at other sizes
//   mirror_benchmark --cuboids                    how the ratios fall with the number of mirrors,
//   CSV
//   mirror_benchmark --choice                     times only, at four sizes, and what auto takes
//
// Times are medians of five, processor time of all threads and the clock, of the stages "beams"
// and "view rays". Mirrors scatter a twentieth where pictures are compared, so that each one tells
// on a pixel, and nothing where they are timed.
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

/// A picture to be followed through its mirrors.
class Run {
 public:
  explicit Run(const MirrorPicture& picture)
      : picture_(picture),
        rays_(picture.scene.soup, picture.scene.materials),
        camera_(picture.view),
        backdrop_{nullptr, {}, &surroundings_} {}
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  TracedPicture traced(MirrorMethod method, MirrorReport& report) const {
    return trace_picture(*paths(method, report), rays_, picture_.view);
  }

  struct Timed {
    Seconds seconds{};
    std::uint64_t queries = 0;  ///< of the scene
    MirrorReport report;
  };
  Timed timed(MirrorMethod method) const {
    Timed made;
    Progress progress;
    made.seconds = median_time([&] {
      made.report = {};
      made.queries = find_shading_points(camera_, rays_, *paths(method, made.report),
                                         PointPlace::First, progress)
                         .rays;
    });
    made.queries += made.report.queries;
    return made;
  }

 private:
  std::unique_ptr<PixelPaths> paths(MirrorMethod method, MirrorReport& report) const {
    Progress progress;
    return pixel_paths(camera_, rays_, backdrop_, {method, picture_.depth, false}, progress,
                       report);
  }

  const MirrorPicture& picture_;
  CheckeredCube surroundings_;
  RayVisibility rays_;
  PerspectiveCamera camera_;
  Backdrop backdrop_;
};

MirrorPicture with_black_mirrors(MirrorPicture picture) {
  picture.scene.materials[1].reflectance = {};
  return picture;
}

std::string name_of(MirrorMethod used) { return used == MirrorMethod::Beams ? "beams" : "rays"; }

void write_picture(const TracedPicture& picture, std::string name, const std::string& folder) {
  std::replace(name.begin(), name.end(), ' ', '_');
  const ToneMapOptions how{.curve = ToneCurve::Reinhard, .ev100 = {}, .key = 0.4};
  write_png(folder + "/" + name + ".png", tone_map(picture.image, how), {});
}

void say_times(const MirrorPicture& picture) {
  const MirrorPicture black = with_black_mirrors(picture);
  const Run run(black);
  const Run::Timed beams = run.timed(MirrorMethod::Beams), rays = run.timed(MirrorMethod::Rays),
                   any = run.timed(MirrorMethod::Auto);
  fmt::print("\"{}\",{},{},{},{},{},{:.1f},{:.4f},{:.4f},{:.4f},{:.4f},{:.2f},{},{:.4f},{}",
             picture.name, picture.view.width, beams.report.mirrors, beams.report.regions,
             beams.queries, rays.queries,
             static_cast<double>(rays.queries) / static_cast<double>(beams.queries),
             beams.seconds.processor, rays.seconds.processor, beams.seconds.clock,
             rays.seconds.clock, rays.seconds.processor / beams.seconds.processor,
             name_of(any.report.used), any.seconds.processor, beams.report.work);
  std::cout.flush();
}

void measure(const MirrorPicture& picture, const std::string& folder) {
  say_times(picture);
  const Run run(picture);
  MirrorReport by_beams, by_rays;
  const TracedPicture beams = run.traced(MirrorMethod::Beams, by_beams),
                      rays = run.traced(MirrorMethod::Rays, by_rays);
  const PictureDifference off = difference(beams, rays);
  fmt::print(",{:.2g},{:.4f},{:.2f}\n", off.away_from_edge, 100.0 * off.differing,
             100.0 * off.edge_share);
  std::cout.flush();
  if (!folder.empty()) write_picture(beams, picture.name, folder);
}

}  // namespace
}  // namespace tenku::testing_support

int main(int count, char** words) {
  using namespace tenku::testing_support;
  const std::string word = count > 1 ? words[1] : "";
  fmt::print(
      "scene,side,mirrors,regions,queries_beams,queries_rays,query_ratio,processor_s_beams,"
      "processor_s_rays,clock_s_beams,clock_s_rays,gain,auto,processor_s_auto,work,"
      "away_from_edges,differing_pct,edges_pct\n");
  if (word == "--paper") {
    for (const int side : {256, 512, 1024}) {
      MirrorPicture paper = one_cuboid();
      paper.view.width = paper.view.height = side;
      measure(paper, "");
    }
    return 0;
  }
  if (word == "--choice") {
    std::vector<MirrorPicture> pictures = mirror_pictures();
    pictures.insert(pictures.end(), {scattered_cuboids(260), scattered_facade(), glass_house()});
    for (MirrorPicture& picture : pictures) {
      for (const int side : {128, 256, 512, 1024}) {
        picture.view.width = picture.view.height = side;
        say_times(picture);
        fmt::print("\n");
      }
    }
    return 0;
  }
  if (word == "--cuboids") {
    for (const int n : {1, 4, 16, 33, 66, 130, 260}) measure(scattered_cuboids(n), "");
    return 0;
  }
  for (const MirrorPicture& picture : mirror_pictures()) measure(picture, word);
  return 0;
}
