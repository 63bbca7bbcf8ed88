#include "study/scene_reflection.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "illuminance/lamp_sampler.h"
#include "meshing/mesh_surfaces.h"

namespace tenku {
namespace {

constexpr double kRoom_m = 60.0;
constexpr std::size_t kRoomTriangles = 20000;
constexpr int kAllBounces = 5;

/// Whether paths find the light of lamps only with luck: of many, most of them hidden, they look at
/// the wrong ones; behind mirrors they look at none.
bool are_lamps_hard(const LitScene& lit) {
  const std::vector<Material>& materials = lit.scene().materials;
  std::size_t lamps = 0;
  bool any_mirror = false;
  for (const std::uint32_t m : lit.soup().material) {
    lamps += luminance_of(materials[m].emission_lm_m2) > 0.0;
    any_mirror |= materials[m].mirror > 0.0;
  }
  return lamps > LampSampler::kMostGroups || (lamps > 0 && any_mirror);
}

}  // namespace

bool is_room(const LitScene& lit) {
  return !lit.place_looked_at() && lit.soup().size() <= kRoomTriangles &&
         lit.extent().longest_side() <= kRoom_m;
}

SceneReflection::SceneReflection(const LitScene& lit, Reflection how) : lit_(lit), how_(how) {
  finder_.all = [this](const Sensors& sensors, SensorIlluminance& values, Progress& progress) {
    if (!light_) solve(progress);
    InteriorSensors look = interior_->look_from(sensors);
    interior_->add_reflected(look, *light_, values, progress);
  };
  finder_.without_lamps = [this](const Sensors& places, int mean_of, SensorIlluminance& values,
                                 Progress& progress) {
    if (!light_) solve(progress);
    interior_->add_reflected_to_pixels(places, mean_of, *light_, values, progress);
  };
  const auto lamps = [this](bool on_edges) {
    return [this, on_edges](const Sensors& points, SensorIlluminance& values, Progress& progress) {
      if (!light_) solve(progress);
      interior_->add_lamps(points, *light_, on_edges, values, progress);
    };
  };
  finder_.lamps = lamps(false);
  finder_.lamps_on_edges = lamps(true);
}

bool SceneReflection::is_by_radiosity(int bounces) const {
  if (how_ == Reflection::Paths || bounces < kAllBounces) return false;
  if (how_ == Reflection::Radiosity) return true;
  return is_room(lit_);
}

const ReflectionFinder* SceneReflection::finder(const IlluminanceOptions& options,
                                                const LightMethod& method) {
  if (!is_by_radiosity(options.bounces)) {
    if (options.bounces > 0 && !told_of_lamps_ && are_lamps_hard(lit_)) tell_of_lamps();
    return nullptr;
  }
  direct_ = options;
  direct_.bounces = 0;
  direct_.share_reflected_m = 0.0;
  method_ = method;
  return &finder_;
}

void SceneReflection::tell_of_lamps() {
  told_of_lamps_ = true;
  Finding finding;
  finding.code = "lamps_by_paths";
  finding.what =
      "paths look at one point of the lamps at a time, and meet those in mirrors by chance: where "
      "many are hidden, or small ones mirrored, values may be too low, and their intervals too "
      "narrow";
  finding.repair = "--reflection radiosity with five bounces or more, or tenku radiosity";
  findings_.push_back(std::move(finding));
}

void SceneReflection::tell(std::vector<Finding>& findings) {
  std::move(findings_.begin(), findings_.end(), std::back_inserter(findings));
  findings_.clear();
}

void SceneReflection::solve(Progress& progress) {
  MeshedScene meshed =
      mesh_scene(lit_.scene(), lit_.soup(), {.tolerance_pct = direct_.tolerance_pct});
  mesh_ = std::make_unique<ElementMesh>(std::move(meshed.mesh));
  InteriorOptions how;
  how.shot.seed = direct_.seed;
  how.tolerance_pct = direct_.tolerance_pct;
  how.lift_m = lit_.rays().lift_m();
  interior_ = std::make_unique<Interior>(*mesh_, lit_.scene().materials, how);
  const DaylightMethod daylight{lit_.engines(), lit_.source(), direct_, method_};
  const bool is_day = lit_.source().unobstructed_lux() > 0.0;
  light_ = interior_->light({is_day ? &daylight : nullptr, 1.0}, progress);
  findings_ = std::move(meshed.findings);
  findings_.insert(findings_.end(), light_->findings.begin(), light_->findings.end());
}

}  // namespace tenku
