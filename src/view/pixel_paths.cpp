#include "view/pixel_paths.h"

#include <algorithm>

#include "view/beam_paths.h"
#include "view/ray_paths.h"

namespace tenku {
namespace {

bool any_mirror(const RayVisibility& rays) {
  const auto& used = rays.soup().material;
  return rays.has_glass() || std::any_of(used.begin(), used.end(), [&](std::uint32_t m) {
           return rays.materials()[m].mirror > 0.0;
         });
}

Finding fell_back(std::size_t mirrors) {
  Finding finding;
  finding.code = "mirrors_by_rays";
  finding.severity = Severity::Note;
  finding.what =
      "mirrors are followed by single rays: cutting the picture into regions would take longer";
  finding.repair = "nothing to do: the picture is the same";
  finding.count = mirrors;
  return finding;
}

/// What the division of a window may take (`BeamTree::work`) before single rays are the faster way:
/// foretold from the ways of one ray in 256.
///
/// Counted, not timed, so that a picture is made in the same way on every run. The times were
/// measured in pictures of 6 to 10,000 mirrors (docs/benchmarks.md).
/// @param are_told  the regions tell every face; otherwise a ray is sent to what is no mirror
std::uint64_t work_of_rays(const PerspectiveCamera& camera, const PixelPaths& rays, bool are_told) {
  constexpr int kStep = 8;
  PixelPath path;
  double saved = 0.0;
  for (int y = kStep / 2; y < camera.height(); y += kStep) {
    for (int x = kStep / 2; x < camera.width(); x += kStep) {
      path.clear();
      path.rays = 0;
      rays.follow(x, y, static_cast<std::size_t>(x / kStep + y / kStep) % kRayPlaces.size(), path);
      const bool sends_one = !are_told && !path.points.empty();
      saved += static_cast<double>(path.rays) - (sends_one ? 1.0 : 0.0);
    }
  }
  // A query takes 0.2 to 0.35 us, of which 0.15 to 0.26 are saved; see `BeamTree::work`.
  constexpr double kSaved = 1.45;
  constexpr double kStandsFor = kStep * kStep * static_cast<double>(kRayPlaces.size());
  return static_cast<std::uint64_t>(std::max(0.0, kSaved * kStandsFor * saved));
}

}  // namespace

std::unique_ptr<PixelPaths> pixel_paths(const PerspectiveCamera& camera, const RayVisibility& rays,
                                        const Backdrop& backdrop, const MirrorOptions& options,
                                        Progress& progress, MirrorReport& report) {
  check_mirror_depth(options.depth);
  MirrorOptions followed = options;
  if (options.method == MirrorMethod::Off) followed.depth = 0;
  const auto by_rays = [&] { return std::make_unique<RayPaths>(camera, rays, backdrop, followed); };
  report.used = options.method == MirrorMethod::Off ? MirrorMethod::Off : MirrorMethod::Rays;
  if (options.method == MirrorMethod::Off || options.method == MirrorMethod::Rays) return by_rays();
  const bool may_choose = options.method == MirrorMethod::Auto;
  if (may_choose && !any_mirror(rays)) return by_rays();

  constexpr std::size_t kMostRegions = 4'000'000, kFewFaces = 2000;
  BeamFaces faces(rays.soup(), rays.materials());
  report.mirrors = faces.mirrors();
  BeamOptions how;
  how.depth = followed.depth;
  how.most_regions = kMostRegions;
  const bool are_told = faces.faces().size() <= kFewFaces;
  how.told_from = are_told ? 0 : followed.depth + 1;
  if (may_choose) how.most_work = work_of_rays(camera, *by_rays(), are_told);
  const double w = camera.width(), h = camera.height();
  const std::array<WindowPoint, 4> window{{{0, 0}, {w, 0}, {w, h}, {0, h}}};
  progress.begin("beams", 0);
  BeamTree tree = trace_beams(faces, camera.window(), window, how, progress);
  progress.end(std::to_string(tree.regions.size()) + " regions");
  if (!tree.is_complete) {
    report.findings.push_back(fell_back(report.mirrors));
    return by_rays();
  }
  report.used = MirrorMethod::Beams;
  report.regions = tree.regions.size();
  report.queries = tree.queries;
  report.work = tree.work;
  return std::make_unique<BeamPaths>(camera, rays, backdrop, followed, std::move(faces),
                                     std::move(tree));
}

}  // namespace tenku
