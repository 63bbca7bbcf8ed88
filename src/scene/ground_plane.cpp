#include "scene/ground_plane.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "scene/set_on_ground.h"

namespace tenku {
namespace {

constexpr double kHill_m = 20.0;  // beyond, a level ground is a poor one
constexpr double kLeastMargin_m = 100.0, kMarginPerHeight = 3.0;

/// The direction of the file that points up, in units of the file per metre.
Vec3 file_up(const Scene& scene) { return scene.frame.to_file(kZenith) - scene.frame.to_file({}); }

double file_height(const Scene& scene, Vec3 local) {
  const Vec3 up = file_up(scene);
  return dot(scene.frame.to_file(local), up) / length(up) + 0.0;
}

double local_height(const Scene& scene, double height) {
  return (height - file_height(scene, {})) / length(file_up(scene));
}

}  // namespace

void add_ground(RawScene& raw, const GroundChoice& choice) {
  Scene& scene = raw.scene;
  if (choice.kind == GroundChoice::Kind::None) return;
  const bool is_auto = choice.kind == GroundChoice::Kind::Auto;
  if (is_auto && (!scene.is_city || scene.has_terrain)) return;
  const Extent box = extent_of_surfaces(scene);
  const double z = is_auto ? box.min.z : local_height(scene, choice.height);
  if (is_auto) {
    const auto [count, farthest] = lower_feet(raw, [z](double, double) { return z; });
    if (count > 0) {
      raw.findings.add(
          {"feet_lowered", farthest > kHill_m ? Severity::Warning : Severity::Note, "", "",
           fmt::format("{} buildings stand above the ground under the city, by up to "
                       "{:.1f} m",
                       count, farthest),
           "their walls were drawn down to it, so that no light comes from below; a scene "
           "with terrain tells more",
           count});
    }
  }
  const double margin = std::max(kLeastMargin_m, kMarginPerHeight * (box.max.z - box.min.z));
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  scene.vertices.push_back({box.min.x - margin, box.min.y - margin, z});
  scene.vertices.push_back({box.max.x + margin, box.min.y - margin, z});
  scene.vertices.push_back({box.max.x + margin, box.max.y + margin, z});
  scene.vertices.push_back({box.min.x - margin, box.max.y + margin, z});
  for (std::uint32_t k = 0; k < 4; ++k) scene.surfaces.vertex.push_back(first + k);
  end_ring(scene.surfaces);
  SurfaceFacts facts;
  facts.type = SurfaceType::Ground;
  facts.object = static_cast<std::uint32_t>(scene.objects.size());
  end_surface(scene.surfaces, facts);
  scene.objects.push_back({kGroundObjectId, ""});
  raw.is_building.push_back(0);
  char height[32];
  std::snprintf(height, sizeof height, "%.3f", file_height(scene, {0.0, 0.0, z}));
  raw.findings.add({"ground_added", Severity::Note, kGroundObjectId,
                    std::string("height ") + height,
                    is_auto ? "the city has no terrain" : "a ground was asked for",
                    "a horizontal ground was put under it; --ground none leaves it out"});
}

}  // namespace tenku
