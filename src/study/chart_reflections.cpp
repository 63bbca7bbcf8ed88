#include "study/chart_reflections.h"

#include <fmt/format.h>

#include "illuminance/planned_light.h"
#include "study/scene_reflection.h"

namespace tenku {
namespace {

constexpr int kUsualBounces = 5, kAllBounces = 20;
constexpr double kMiddling = 5.0;  // percent, tolerance where bounces are compared

struct ReflectionWay {
  Reflection how = Reflection::Paths;
  double tolerance_pct = 2.0;
  int bounces = kUsualBounces;
};

SensorValues all_light(const LitScene& lit, const Sensors& sensors, const ReflectionWay& way,
                       std::uint64_t seed, Progress& progress) {
  IlluminanceOptions options;
  options.tolerance_pct = way.tolerance_pct;
  options.bounces = way.bounces;
  options.seed = seed;
  const LightMethod method;
  SceneReflection reflection(lit, way.how);
  options.reflection = reflection.finder(options, method);
  return values_of(
      illuminate(sensors, lit.engines(), lit.source(), options, method, progress).values);
}

}  // namespace

void add_reflection_stage(const LitScene& lit, const Sensors& sensors, std::uint64_t seed,
                          std::vector<ChartSetting>& settings,
                          std::vector<ChartReference>& references) {
  references.push_back({fmt::format("all light, {} reflections by paths", kAllBounces),
                        {8.0, 4.0, 2.0, 1.0, 0.5},
                        [&](double tolerance, std::uint64_t run_seed, Progress& progress) {
                          return all_light(lit, sensors,
                                           {.tolerance_pct = tolerance, .bounces = kAllBounces},
                                           run_seed, progress);
                        }});
  const auto add = [&](const std::string& method, const std::string& setting,
                       const std::string& study, const ReflectionWay& way) {
    settings.push_back({"reflections", method, setting, study, references.size() - 1,
                        [&lit, &sensors, way, seed](Progress& progress) {
                          return all_light(lit, sensors, way, seed, progress);
                        }});
  };
  const auto by_tolerance = [&](const char* name, Reflection how, double tolerance) {
    add(name, tolerance_text(tolerance),
        fmt::format("reflection = \"{}\"\ntolerance_percent = {:.1f}\n", name, tolerance),
        {.how = how, .tolerance_pct = tolerance});
  };
  for (const double tolerance : {20.0, 10.0, 5.0, 2.0, 1.0}) {
    by_tolerance("paths", Reflection::Paths, tolerance);
  }
  for (const int bounces : {0, 1, 2}) {
    add("bounces", fmt::format("{}", bounces),
        fmt::format("bounces = {}\ntolerance_percent = {:.1f}\n", bounces, kMiddling),
        {.tolerance_pct = kMiddling, .bounces = bounces});
  }
  if (!is_room(lit)) return;
  for (const double tolerance : {20.0, 10.0, 5.0, 2.0}) {
    by_tolerance("radiosity", Reflection::Radiosity, tolerance);
  }
}

}  // namespace tenku
