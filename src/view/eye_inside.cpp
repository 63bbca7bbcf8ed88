#include "view/eye_inside.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tenku {
namespace {

constexpr int kDirections = 64;
constexpr int kLeastBacks = 58;  // a building may have a face or two the wrong way round

/// Evenly over the sky: on a spiral, each for an equal solid angle.
Vec3 spread_direction(int k) {
  const double golden = kPi * (3.0 - std::sqrt(5.0));
  const double z = (k + 0.5) / kDirections, level = std::sqrt(1.0 - z * z);
  return {level * std::cos(golden * k), level * std::sin(golden * k), z};
}

}  // namespace

std::optional<Finding> eye_inside(Vec3 eye, const Scene& scene, const RayVisibility& rays) {
  std::map<std::uint32_t, int> met;  // object -> directions
  int backs = 0;
  for (int k = 0; k < kDirections; ++k) {
    const Vec3 direction = spread_direction(k);
    const auto hit = rays.first_hit(eye, direction);
    if (!hit) return std::nullopt;
    backs += dot(rays.normal(hit->triangle), direction) > 0.0 ? 1 : 0;
    ++met[rays.soup().object[hit->triangle]];
  }
  if (backs < kLeastBacks) return std::nullopt;
  const auto most = std::max_element(
      met.begin(), met.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const std::string& id = scene.objects[most->first].id;
  const Vec3 at = scene.frame.to_file(eye);
  const bool is_below = id == kGroundObjectId;
  return Finding{"eye_inside",
                 Severity::Warning,
                 id,
                 fmt::format("eye at {:.2f} {:.2f} {:.2f}", at.x, at.y, at.z),
                 is_below ? "the camera is below the ground"
                          : fmt::format("the camera is inside object [{}]: it sees no sky and only "
                                        "the backs of faces",
                                        id),
                 "move --eye into the open"};
}

}  // namespace tenku
