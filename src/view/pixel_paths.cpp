#include "view/pixel_paths.h"

#include <algorithm>
#include <string>

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

Finding fell_back(std::size_t most, std::size_t mirrors) {
  Finding finding;
  finding.code = "mirrors_by_rays";
  finding.what = "mirrors divide the picture into more than " + std::to_string(most) +
                 " regions; they are followed by single rays";
  finding.repair = "nothing to do: the picture is the same";
  finding.count = mirrors;
  return finding;
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

  constexpr std::size_t kPixelsARegion = 16, kMostRegions = 4'000'000, kFewFaces = 2000;
  const auto pixels =
      static_cast<std::size_t>(camera.width()) * static_cast<std::size_t>(camera.height());
  BeamFaces faces(rays.soup(), rays.materials());
  report.mirrors = faces.mirrors();
  BeamOptions how;
  how.depth = followed.depth;
  how.told_from = faces.faces().size() <= kFewFaces ? 0 : followed.depth + 1;
  how.most_regions =
      may_choose ? std::max<std::size_t>(1000, pixels / kPixelsARegion) : kMostRegions;
  const double w = camera.width(), h = camera.height();
  const std::array<WindowPoint, 4> window{{{0, 0}, {w, 0}, {w, h}, {0, h}}};
  progress.begin("beams", 0);
  BeamTree tree = trace_beams(faces, camera.window(), window, how, progress);
  progress.end(std::to_string(tree.regions.size()) + " regions");
  if (!tree.is_complete) {
    report.findings.push_back(fell_back(how.most_regions, report.mirrors));
    return by_rays();
  }
  report.used = MirrorMethod::Beams;
  report.regions = tree.regions.size();
  report.queries = tree.queries;
  return std::make_unique<BeamPaths>(camera, rays, backdrop, followed, std::move(faces),
                                     std::move(tree));
}

}  // namespace tenku
