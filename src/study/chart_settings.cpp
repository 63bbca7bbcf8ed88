#include "study/chart_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>

#include "core/error.h"
#include "form_factors/form_factor.h"
#include "illuminance/planned_light.h"
#include "meshing/mesh_surfaces.h"
#include "radiosity/interior.h"
#include "radiosity/mesh_loop.h"
#include "study/chart_reflections.h"
#include "study/scene_reflection.h"

namespace tenku {
namespace {

constexpr double kDirectOfInteriors = 1.0;  // percent, tolerance of the direct light in rooms

/// Direct light of one way.
struct DirectWay {
  EngineChoice engine = EngineChoice::Rays;
  Detail detail = Detail::Budget;
  double tolerance_pct = 2.0;
  std::optional<PartitionRequest> partition{};
  bool by_slices = false;
};

SensorValues direct_light(const LitScene& lit, const Sensors& sensors, const DirectWay& way,
                          std::uint64_t seed, Progress& progress) {
  const DaylightSource source = daylight_of(lit.sky(), way.partition);
  IlluminanceOptions how;
  how.tolerance_pct = way.tolerance_pct;
  how.bounces = 0;
  how.seed = seed;
  how.by_slices = way.by_slices;
  if (way.by_slices)
    return values_of(illuminate(sensors, lit.rays(), source, how, progress).values);
  LightMethod method;
  method.engine = way.engine;
  method.detail = way.detail;
  return values_of(illuminate(sensors, lit.engines(), source, how, method, progress).values);
}

PartitionRequest elements(PartitionMethod method, std::size_t count) {
  PartitionRequest request;
  request.method = method;
  request.elements = count;
  return request;
}

/// How an interior is solved.
struct InteriorWay {
  std::string form_factors = "hemisphere-rays";
  int resolution = 0;  ///< of shots and corners; 0: as usual
  Mesher mesher = Mesher::Uniform;
  double tolerance_pct = 5.0;
};

}  // namespace

/// Found once, and shared by all settings of interiors.
struct ChartSettings::DirectLight {
  std::once_flag once;
  SensorIlluminance values{0};
};

std::vector<std::string> chart_stages() {
  return {"sky",  "visibility", "lod",     "reflections", "form-factors",
          "mesh", "picture",    "mirrors", "fly-through"};
}

void check_chart_stages(const std::vector<std::string>& stages) {
  const std::vector<std::string> known = chart_stages();
  for (const std::string& stage : stages) {
    if (stage == "all" || std::find(known.begin(), known.end(), stage) != known.end()) continue;
    throw InputError(fmt::format("there is no stage '{}' to chart: there are {} and all", stage,
                                 fmt::join(known, ", ")));
  }
}

ChartSettings::ChartSettings(const LitScene& lit, const Sensors& sensors, const ChartView& view,
                             std::vector<std::string> stages, std::uint64_t seed)
    : lit_(lit),
      sensors_(sensors),
      stages_(std::move(stages)),
      seed_(seed),
      direct_(std::make_shared<DirectLight>()) {
  check_chart_stages(stages_);
  if (wants("all")) {
    stages_ = {"sky", "visibility", "lod", "reflections", "picture", "fly-through"};
    if (is_room(lit)) stages_.insert(stages_.end(), {"form-factors", "mesh"});
    if (has_mirrors(lit)) stages_.push_back("mirrors");
  }
  if (wants("mirrors") && !has_mirrors(lit)) {
    throw InputError("--stage mirrors: the scene has none to compare");
  }
  const bool is_day = lit.sky().model != nullptr;
  if (is_day && (wants("sky") || wants("visibility") || wants("lod"))) add_direct_reference();
  if (is_day && wants("sky")) add_sky();
  if (is_day && wants("visibility")) add_visibility();
  if (is_day && wants("lod")) add_detail();
  if (wants("reflections")) add_reflection_stage(lit, sensors, seed, settings_, references_);
  if (wants("form-factors") || wants("mesh")) add_interior_reference();
  if (wants("form-factors")) add_form_factors();
  if (wants("mesh")) add_meshes();
  const std::pair<const char*, PictureStage*> pictures[] = {{"picture", add_picture_stage},
                                                            {"mirrors", add_mirror_stage},
                                                            {"fly-through", add_fly_through_stage}};
  for (const auto& [name, add] : pictures) {
    if (wants(name)) add(lit, view, seed, settings_, references_);
  }
  if (settings_.empty()) throw InputError("without a sky there is nothing to compare here");
}

ChartSettings::~ChartSettings() = default;

bool ChartSettings::wants(const std::string& stage) const {
  return std::find(stages_.begin(), stages_.end(), stage) != stages_.end();
}

void ChartSettings::add_direct_reference() {
  references_.push_back({"direct light by slices",
                         {4.0, 2.0, 1.0, 0.5, 0.25, 0.12},
                         [this](double tolerance, std::uint64_t seed, Progress& progress) {
                           return direct_light(lit_, sensors_,
                                               {.tolerance_pct = tolerance, .by_slices = true},
                                               seed, progress);
                         }});
}

void ChartSettings::add_sky() {
  const auto add = [&](const std::string& method, const std::string& setting,
                       const std::string& study, const DirectWay& way) {
    settings_.push_back(
        {"sky", method, setting, study, references_.size() - 1, [this, way](Progress& progress) {
           return direct_light(lit_, sensors_, way, seed_, progress);
         }});
  };
  const auto by_elements = [&](const std::string& name, const PartitionRequest& request,
                               const std::string& setting, const std::string& count) {
    add(name, setting, "engine = \"rays\"\nlod = \"off\"\npartition = \"" + name + "\"\n" + count,
        {.detail = Detail::Off, .tolerance_pct = 100.0, .partition = request});
  };
  constexpr std::size_t kLeast = 32, kMost = 1024;
  const std::pair<const char*, PartitionMethod> methods[] = {
      {"adaptive", PartitionMethod::Adaptive},
      {"energy", PartitionMethod::Energy},
      {"uniform", PartitionMethod::Uniform}};
  for (const auto& [name, method] : methods) {
    for (std::size_t n = kLeast; n <= kMost; n *= 2) {
      by_elements(name, elements(method, n), fmt::format("{} elements", n),
                  fmt::format("elements = {}\n", n));
    }
  }
  for (const char* name : {"tregenza", "reinhart:2"}) {
    by_elements(name, parse_partition(name), "as published", "");
  }
  for (const double tolerance : {20.0, 10.0, 5.0, 2.0, 1.0}) {
    add("slices", tolerance_text(tolerance),
        fmt::format("engine = \"rays\"\ntolerance_percent = {:.1f}\n", tolerance),
        {.tolerance_pct = tolerance, .by_slices = true});
  }
}

void ChartSettings::add_visibility() {
  const std::pair<const char*, EngineChoice> engines[] = {
      {"rays", EngineChoice::Rays}, {"shadow-maps", EngineChoice::ShadowMaps}};
  for (const auto& [name, engine] : engines) {
    for (const std::size_t n : {64, 256}) {
      const DirectWay way{.engine = engine,
                          .detail = Detail::Off,
                          .tolerance_pct = 100.0,
                          .partition = elements(PartitionMethod::Adaptive, n)};
      settings_.push_back(
          {"visibility", name, fmt::format("{} elements", n),
           fmt::format("engine = \"{}\"\nlod = \"off\"\npartition = \"adaptive\"\nelements = {}\n",
                       name, n),
           references_.size() - 1, [this, way](Progress& progress) {
             return direct_light(lit_, sensors_, way, seed_, progress);
           }});
    }
  }
}

void ChartSettings::add_detail() {
  for (const double tolerance : {20.0, 10.0, 5.0, 2.0, 1.0}) {
    const DirectWay way{.engine = EngineChoice::Auto, .tolerance_pct = tolerance};
    settings_.push_back({"lod", "budget", tolerance_text(tolerance),
                         fmt::format("tolerance_percent = {:.1f}\n", tolerance),
                         references_.size() - 1, [this, way](Progress& progress) {
                           return direct_light(lit_, sensors_, way, seed_, progress);
                         }});
  }
  for (const std::size_t n : {128, 512}) {
    const DirectWay way{.engine = EngineChoice::Auto,
                        .detail = Detail::Off,
                        .tolerance_pct = 100.0,
                        .partition = elements(PartitionMethod::Energy, n)};
    settings_.push_back({"lod", "off", fmt::format("{} elements", n),
                         fmt::format("lod = \"off\"\npartition = \"energy\"\nelements = {}\n", n),
                         references_.size() - 1, [this, way](Progress& progress) {
                           return direct_light(lit_, sensors_, way, seed_, progress);
                         }});
  }
}

namespace {

/// Daylight and lamps after all reflections.
/// @param direct  on the sensors, found before
SensorValues interior_light(const LitScene& lit, const Sensors& sensors, const InteriorWay& way,
                            const SensorIlluminance& direct, std::uint64_t seed,
                            Progress& progress) {
  InteriorOptions how;
  how.form_factors = way.form_factors;
  if (way.resolution > 0) how.shot.resolution = how.point_resolution = way.resolution;
  how.shot.seed = seed;
  how.tolerance_pct = way.tolerance_pct;
  how.lift_m = lit.rays().lift_m();
  MeshLoopOptions loop_options;
  loop_options.mesher = way.mesher;
  loop_options.tolerance_pct = way.tolerance_pct;
  MeshedScene first = mesh_scene(lit.scene(), lit.soup(), {.tolerance_pct = way.tolerance_pct});
  MeshLoop loop(std::move(first), lit.scene().materials, how, loop_options);
  IlluminanceOptions daylight_options;
  daylight_options.tolerance_pct = way.tolerance_pct;
  daylight_options.bounces = 0;
  daylight_options.seed = seed;
  const DaylightMethod daylight{lit.engines(), lit.source(), daylight_options, LightMethod{}};
  const bool is_day = lit.source().unobstructed_lux() > 0.0;
  loop.run({is_day ? &daylight : nullptr, 1.0}, progress);
  InteriorSensors look = loop.interior().look_from(sensors);
  SensorIlluminance values = direct;
  loop.interior().add_reflected(look, loop.light(), values, progress);
  return values_of(values);
}

}  // namespace

void ChartSettings::add_interior_reference() {
  references_.push_back({"light after all reflections, by radiosity",
                         {4.0, 2.0, 1.0, 0.5},
                         [this](double tolerance, std::uint64_t seed, Progress& progress) {
                           std::call_once(direct_->once, [&] {
                             IlluminanceOptions how;
                             how.tolerance_pct = kDirectOfInteriors;
                             how.bounces = 0;
                             how.seed = seed_;
                             const DaylightSource source = daylight_of(lit_.sky());
                             direct_->values =
                                 illuminate(sensors_, lit_.rays(), source, how, progress).values;
                           });
                           return interior_light(lit_, sensors_, {.tolerance_pct = tolerance},
                                                 direct_->values, seed, progress);
                         }});
}

void ChartSettings::add_form_factors() {
  for (const std::string_view method : form_factor_method_names()) {
    for (const int resolution : {8, 16, 32, 64}) {
      const bool is_closed_form = method == "analytic";
      if (is_closed_form && resolution > 8) continue;
      const InteriorWay way{.form_factors = std::string(method), .resolution = resolution};
      settings_.push_back(
          {"form-factors", std::string(method),
           is_closed_form ? "closed form" : fmt::format("resolution {}", resolution), "",
           references_.size() - 1, [this, way](Progress& progress) {
             return interior_light(lit_, sensors_, way, direct_->values, seed_, progress);
           }});
    }
  }
}

void ChartSettings::add_meshes() {
  const std::pair<const char*, Mesher> meshers[] = {
      {"uniform", Mesher::Uniform}, {"refine", Mesher::Refine}, {"bubble", Mesher::Bubble}};
  for (const auto& [name, mesher] : meshers) {
    for (const double tolerance : {20.0, 10.0, 5.0, 2.0}) {
      const InteriorWay way{.mesher = mesher, .tolerance_pct = tolerance};
      const bool is_default = mesher == Mesher::Uniform;
      settings_.push_back(
          {"mesh", name, tolerance_text(tolerance),
           is_default
               ? fmt::format("reflection = \"radiosity\"\ntolerance_percent = {:.1f}\n", tolerance)
               : "",
           references_.size() - 1, [this, way](Progress& progress) {
             return interior_light(lit_, sensors_, way, direct_->values, seed_, progress);
           }});
    }
  }
}

}  // namespace tenku
