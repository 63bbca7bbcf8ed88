#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/lit_scene_options.h"
#include "cli/option_list.h"
#include "cli/sensor_options.h"
#include "cli/view_options.h"
#include "core/error.h"
#include "core/parallel.h"
#include "study/chart_files.h"
#include "study/chart_settings.h"
#include "study/scene_reflection.h"
#include "study/time_limit.h"

namespace tenku {
namespace {

constexpr double kUsualSensors = 400.0;

struct ChartOptions {
  LitSceneOptions lit;
  SensorOptions sensors;
  ViewOptions view;
  std::string budget = "120s";
  std::vector<std::string> stages{"all"};
};

/// Without those that see neither sky nor sun, as on the ground inside of buildings.
Sensors outdoors(const LitScene& lit, const Sensors& all, Progress& progress) {
  IlluminanceOptions how;
  how.tolerance_pct = 20.0;
  how.bounces = 0;
  const SensorIlluminance light = illuminate(all, lit.rays(), lit.source(), how, progress).values;
  std::vector<std::uint32_t> seeing;
  for (std::uint32_t s = 0; s < all.size(); ++s) {
    if (light.sun_lux[s] > 0.0 || light.sky_lux[s] > 0.0) seeing.push_back(s);
  }
  return seeing.empty() ? all : sensors_of(all, seeing);
}

/// Some hundred on what there is first of ground, roofs and walls.
Sensors usual_sensors(const LitScene& lit, std::string& told) {
  for (const char* surface : {"ground", "roofs", "walls"}) {
    const std::vector<std::string> one{surface};
    try {
      double spacing = std::max(1e-3, lit.extent().longest_side() / std::sqrt(kUsualSensors));
      for (int attempt = 0; attempt < 6; ++attempt) {
        Sensors sensors = lit.grid(one, spacing).sensors;
        const auto count = static_cast<double>(sensors.size());
        const bool is_last = attempt == 5;
        if (is_last || (count > 0.5 * kUsualSensors && count < 2.0 * kUsualSensors)) {
          told = fmt::format("{} sensors on {}", sensors.size(), surface);
          return sensors;
        }
        spacing *= std::sqrt(std::max(count, 1.0) / kUsualSensors);
      }
    } catch (const InputError&) {
      continue;  // there is no such surface
    }
  }
  throw InputError("there is no surface to put sensors on: give --sensors FILE");
}

/// Some of them, evenly, where there are more than a chart needs.
Sensors thinned(const Sensors& all) {
  constexpr std::size_t kMost = 2000;
  if (all.size() <= kMost) return all;
  Sensors some;
  for (std::size_t k = 0; k < kMost; ++k) {
    const std::size_t s = (2 * k + 1) * all.size() / (2 * kMost);
    some.position.push_back(all.position[s]);
    some.normal.push_back(all.normal[s]);
  }
  return some;
}

void tell(const ChartResult& result, const CommonOptions& common,
          const std::filesystem::path& folder) {
  for (std::size_t r = 0; r < result.references.size(); ++r) {
    for (const double error : kChartErrors) {
      const ChartPoint* best = cheapest_within(result, r, error);
      say(common, best == nullptr ? fmt::format("{:g} %: unreachable here", error)
                                  : fmt::format("{:g} %: {}, {}, {} ({:.3g} s)", error, best->stage,
                                                best->method, best->setting, best->time_s));
    }
  }
  say(common, fmt::format("{} points in {:.1f} s: {}", result.points.size(), result.seconds,
                          (folder / "chart.html").string()));
  if (!common.json) return;
  nlohmann::ordered_json json{
      {"points", result.points.size()}, {"left_out", result.left_out}, {"seconds", result.seconds}};
  for (const ReferenceResult& reference : result.references) {
    json["references"].push_back({{"name", reference.name},
                                  {"tolerance", reference.tolerance_pct},
                                  {"rms_difference", reference.difference.rms},
                                  {"floor", reference.floor},
                                  {"seconds", reference.seconds}});
  }
  fmt::print("{}\n", json.dump(2));
}

int chart(const ChartOptions& options, const CommandContext& context) {
  const double budget_s = seconds_named(options.budget, "a budget");
  check_chart_stages(options.stages);
  check_view_options(options.view);
  const std::filesystem::path folder = options.lit.out;
  if (options.lit.out == "-") throw InputError("a chart needs a folder: --out DIR");
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder)) {
    throw InputError("'" + options.lit.out + "' is a file: --out names a folder");
  }
  if (options.sensors.is_given()) check_sensor_options(options.sensors);
  const LitScene lit = load_lit_scene(options.lit, context.progress);
  ChartStory story{.scene = options.lit.scene.scene,
                   .sensors = {},
                   .budget_s = budget_s,
                   .threads = thread_count(),
                   .seed = context.options.seed};
  Sensors sensors;
  if (options.sensors.is_given()) {
    sensors = thinned(place_sensors(options.sensors, lit).sensors);
    story.sensors = fmt::format("{} sensors", sensors.size());
  } else {
    sensors = usual_sensors(lit, story.sensors);
    const bool is_city = lit.sky().model != nullptr && !is_room(lit);
    if (is_city) sensors = outdoors(lit, sensors, context.progress);
  }
  const ChartView view{view_request(options.view, options.lit, lit, context.options).view,
                       options.lit.bounces};
  const ChartSettings settings(lit, sensors, view, options.stages, context.options.seed);
  const double floor_lux = 0.001 * lit.source().unobstructed_lux();
  const ChartResult result = measure_chart(settings.settings(), settings.references(), budget_s,
                                           floor_lux, context.options.seed, context.progress);
  write_chart(folder, result, lit, sensors, story);
  tell(result, context.options, folder);
  return kDone;
}

}  // namespace

CommandBody make_chart_command(OptionList& app) {
  const auto options = std::make_shared<ChartOptions>();  // outlives this call
  add_scene_options(app, options->lit.scene);
  add_site_options(app, options->lit.site);
  add_sky_options(app, options->lit.sky);
  add_sensor_options(app, options->sensors);
  add_camera_options(app, options->view, "256x256");
  app.add_option("--gl", options->lit.gl,
                 "what draws shadow maps: auto, osmesa or egl (default auto)");
  app.add_option("--stage", options->stages,
                 "sky, visibility, lod, reflections, form-factors, mesh, picture, mirrors, "
                 "fly-through, several with commas, or all (default all)")
      .split_at(',');
  app.add_option("--budget", options->budget, "time that it may take, 120s or 2m (default 120s)");
  app.add_option("--out", options->lit.out, "folder to write into").required();
  return [options](const CommandContext& context) { return chart(*options, context); };
}

}  // namespace tenku
