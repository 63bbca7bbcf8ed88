#include "study/scene_light.h"

#include <utility>

#include "radiosity/mesh_surfaces.h"

namespace tenku {
namespace {

constexpr double kRoom_m = 60.0;
constexpr std::size_t kRoomTriangles = 20000;
constexpr int kAllBounces = 5;

}  // namespace

SceneLight::SceneLight(const LitScene& lit, Reflection reflection)
    : lit_(lit), reflection_(reflection) {}

bool SceneLight::is_by_radiosity(const IlluminanceOptions& options) const {
  if (reflection_ == Reflection::Paths || options.bounces < kAllBounces) return false;
  if (reflection_ == Reflection::Radiosity) return true;
  return lit_.soup().size() <= kRoomTriangles && lit_.extent().longest_side() <= kRoom_m;
}

void SceneLight::solve(const IlluminanceOptions& direct, const LightMethod& method,
                       Progress& progress) {
  MeshedScene meshed =
      mesh_scene(lit_.scene(), lit_.soup(), {.tolerance_pct = direct.tolerance_pct});
  mesh_ = std::make_unique<ElementMesh>(std::move(meshed.mesh));
  findings_ = std::move(meshed.findings);
  InteriorOptions how;
  how.shot.seed = direct.seed;
  how.tolerance_pct = direct.tolerance_pct;
  how.lift_m = lit_.rays().lift_m();
  interior_ = std::make_unique<Interior>(*mesh_, lit_.scene().materials, how);
  const DaylightMethod daylight{lit_.engines(), lit_.source(), direct, method};
  const bool has_light = lit_.source().unobstructed_lux() > 0.0;
  light_ = interior_->light({has_light ? &daylight : nullptr, 1.0}, progress);
  findings_.insert(findings_.end(), light_->findings.begin(), light_->findings.end());
}

IlluminanceResult SceneLight::illuminate(const Sensors& sensors, const IlluminanceOptions& options,
                                         const LightMethod& method, Progress& progress) {
  if (!is_by_radiosity(options)) {
    return tenku::illuminate(sensors, lit_.engines(), lit_.source(), options, method, progress);
  }
  IlluminanceOptions direct = options;
  direct.bounces = 0;
  direct.share_reflected_m = 0.0;
  IlluminanceResult result =
      tenku::illuminate(sensors, lit_.engines(), lit_.source(), direct, method, progress);
  if (!light_) solve(direct, method, progress);
  InteriorSensors look = interior_->look_from(sensors);
  interior_->add_reflected(look, *light_, result.values, progress);
  result.findings.insert(result.findings.end(), findings_.begin(), findings_.end());
  findings_.clear();
  judge_whole(sensors, lit_.source(), options, result);
  return result;
}

}  // namespace tenku
