#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/finding_json.h"
#include "cli/lit_scene_options.h"
#include "cli/option_list.h"
#include "cli/plan_output.h"
#include "cli/sensor_options.h"
#include "cli/view_options.h"
#include "core/error.h"
#include "illuminance/planned_light.h"
#include "view/view_render.h"

namespace tenku {
namespace {

struct PlanOptions {
  LitSceneOptions lit;
  SensorOptions sensors;
  ViewOptions view;
};

ViewPlan plan_sensors(const PlanOptions& options, const LitScene& lit,
                      const CommandContext& context) {
  const Sensors sensors = place_sensors(options.sensors, lit).sensors;
  const IlluminanceOptions how = illuminance_options(options.lit, context.options);
  LightMethod method = light_method(options.lit);
  method.is_predicted = true;
  ViewPlan plan;
  for (RegionWork& region :
       plan_light(sensors, lit.engines(), lit.source(), how, method, context.progress)) {
    plan.regions.push_back(std::move(region.told));
  }
  plan.reflection_s = predicted_reflection_s(sensors, lit.rays(), lit.source(), how);
  return plan;
}

ViewPlan plan_picture(const PlanOptions& options, const LitScene& lit,
                      const CommandContext& context) {
  const ViewRequest request = view_request(options.view, options.lit, lit, context.options);
  return plan_view(request, lit.engines(), lit.source(), context.progress);
}

double predicted_s(const ViewPlan& plan) {
  double sum = plan.reflection_s;
  for (const PlannedRegion& region : plan.regions) sum += region.predicted_s();
  return sum;
}

int plan(const PlanOptions& options, const CommandContext& context) {
  const bool has_sensors = options.sensors.is_given();
  if (has_sensors) {
    check_sensor_options(options.sensors);
    if (detail_named(options.lit.lod) == Detail::Paper) {
      throw InputError("--lod paper goes by polygons in a picture: give no sensors");
    }
  } else {
    check_view_options(options.view);
  }
  const LitScene lit = load_lit_scene(options.lit, context.progress);
  const ViewPlan made =
      has_sensors ? plan_sensors(options, lit, context) : plan_picture(options, lit, context);
  if (context.options.json) {
    const nlohmann::ordered_json json{{"triangles", lit.soup().size()},
                                      {"predicted_s", predicted_s(made)},
                                      {"reflected_s", made.reflection_s},
                                      {"plan", json_of(made.regions)},
                                      {"findings", json_of(lit.scene().findings)}};
    fmt::print("{}\n", json.dump(2));
    return kDone;
  }
  for (const Finding& finding : lit.scene().findings) {
    if (finding.code.starts_with("tiles_")) fmt::print("{}; {}\n", finding.what, finding.repair);
  }
  fmt::print("{} triangles, {}\n{}\n", lit.soup().size(),
             has_sensors ? "sensors as given" : "a picture", table_of(made.regions));
  fmt::print("reflected light, {} bounces: {:.3g} s\nin all: {:.3g} s\n", options.lit.bounces,
             made.reflection_s, predicted_s(made));
  return kDone;
}

}  // namespace

CommandBody make_plan_command(OptionList& app) {
  const auto options = std::make_shared<PlanOptions>();  // outlives this call
  add_lit_scene_options(app, options->lit);
  add_sensor_options(app, options->sensors);
  add_view_options(app, options->view);
  return [options](const CommandContext& context) { return plan(*options, context); };
}

}  // namespace tenku
