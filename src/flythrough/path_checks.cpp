#include "flythrough/path_checks.h"

#include <fmt/format.h>

#include <algorithm>

namespace tenku {
namespace {

constexpr int kMostCrossings = 64;  // between two frames

std::string place_on(const std::vector<CameraKey>& keys, double time_s) {
  std::string place = fmt::format("{:.2f} s", time_s);
  for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
    if (time_s >= keys[k].time_s && time_s <= keys[k + 1].time_s) {
      return fmt::format("{}, between key {} ({:g} s) and key {} ({:g} s)", place, k + 1,
                         keys[k].time_s, k + 2, keys[k + 1].time_s);
    }
  }
  return place;
}

}  // namespace

std::vector<Finding> check_path(const CameraPath& path, const std::vector<CameraKey>& keys,
                                const Scene& scene, const RayVisibility& rays) {
  std::vector<Finding> findings;
  const TriangleSoup& soup = rays.soup();
  for (std::size_t f = 0; f + 1 < path.size(); ++f) {
    const CameraFrame &from = path.frames[f], &to = path.frames[f + 1];
    const double whole = length(to.eye - from.eye);
    if (!(whole > 0.0)) continue;
    const Vec3 direction = (1.0 / whole) * (to.eye - from.eye);
    double gone = 0.0;
    for (int c = 0; c < kMostCrossings; ++c) {
      const auto hit = rays.first_hit(from.eye + gone * direction, direction);
      if (!hit || gone + hit->distance_m > whole) break;
      gone += hit->distance_m;
      const double time = from.time_s + gone / whole * (to.time_s - from.time_s);
      const std::string& object = scene.objects[soup.object[hit->triangle]].id;
      gone += 10.0 * rays.lift_m();
      const auto known =
          std::find_if(findings.begin(), findings.end(),
                       [&](const Finding& finding) { return finding.object == object; });
      if (known != findings.end()) {
        ++known->count;
        continue;
      }
      Finding finding;
      finding.code = "path_through_wall";
      finding.object = object;
      finding.where = place_on(keys, time);
      finding.what = "the camera goes through a surface at " + finding.where;
      finding.repair = "lead the path around it";
      findings.push_back(std::move(finding));
    }
  }
  return findings;
}

}  // namespace tenku
