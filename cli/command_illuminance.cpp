#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "cli/command.h"
#include "cli/lit_scene_options.h"
#include "cli/option_list.h"
#include "cli/sensor_options.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "output/field_writer.h"
#include "output/table_writer.h"
#include "study/illuminance_field.h"
#include "study/map_results.h"
#include "study/scene_reflection.h"
#include "study/surface_results.h"

namespace tenku {
namespace {

struct IlluminanceCommandOptions {
  LitSceneOptions lit;
  SensorOptions sensors;
  std::string decide;
};

bool is_city_file(const std::string& out) { return out.ends_with(".json"); }
bool is_raster(const std::string& out) { return out.ends_with(".tif") || out.ends_with(".tiff"); }
bool is_map(const std::string& out) { return is_raster(out) || out.ends_with(".gpkg"); }

void check_request(const IlluminanceCommandOptions& options) {
  check_sensor_options(options.sensors);
  const std::string& out = options.lit.out;
  const bool is_model = is_city_file(out) || out.ends_with(".glb") || is_map(out);
  if (out != "-" && !out.ends_with(".csv") && !out.ends_with(".vtp") && !is_model) {
    throw InputError("cannot write '" + out +
                     "': the ending must be .csv, .vtp, .city.json, .glb, .tif or .gpkg");
  }
  if (is_model && options.sensors.grid.empty()) {
    throw InputError("values on surfaces (" + out + ") need sensors on surfaces: give --grid");
  }
  check_can_write(out);
}

void write_map(const IlluminanceCommandOptions& options, const LitScene& lit,
               const PlacedSensors& placed, const IlluminanceResult& result) {
  AtomicFile file(options.lit.out);
  if (is_raster(options.lit.out)) {
    map_writer().write_raster(
        file.path(), raster_of_grid(lit, *placed.grid, result.values, options.sensors.spacing_m));
  } else {
    map_writer().write_layers(file.path(), map_crs(lit),
                              layers_of_grid(lit, *placed.grid, result.values));
  }
  file.commit();
}

void write_result(const IlluminanceCommandOptions& options, const LitScene& lit,
                  const PlacedSensors& placed, const IlluminanceResult& result) {
  const std::string& out = options.lit.out;
  if (is_city_file(out)) {
    return write_whole_file(out, cityjson_of_grid(lit, *placed.grid, result.values));
  }
  if (is_map(out)) return write_map(options, lit, placed, result);
  if (out.ends_with(".glb")) {
    return write_whole_file(out, glb_of_grid(lit, *placed.grid, result.values));
  }
  if (!out.ends_with(".vtp")) {
    illuminance_table(placed.in_file.position, placed.in_file.normal, result.values, result.decided)
        .write(out);
    return;
  }
  FieldMesh mesh = placed.grid
                       ? field_of_grid(lit, *placed.grid, result.values, result.decided)
                       : field_of_points(lit, placed.sensors, result.values, result.decided);
  write_vtp(out, mesh);
}

int illuminance(const IlluminanceCommandOptions& options, const CommandContext& context) {
  check_request(options);
  std::optional<DecisionThreshold> decide;
  if (!options.decide.empty()) decide = decision_threshold(options.decide);
  const auto start = std::chrono::steady_clock::now();
  const LitScene lit = load_lit_scene(options.lit, context.progress);
  const PlacedSensors placed = place_sensors(options.sensors, lit);
  IlluminanceOptions how = illuminance_options(options.lit, context.options);
  how.decide = decide;
  const LightMethod method = light_method(options.lit);
  SceneReflection reflection(lit, reflection_named(options.lit.reflection));
  how.reflection = reflection.finder(how, method);
  IlluminanceResult result =
      illuminate(placed.sensors, lit.engines(), lit.source(), how, method, context.progress);
  reflection.tell(result.findings);
  if (auto on_edges = sensors_on_edges(placed.sensors, lit.engines().rays())) {
    result.findings.push_back(std::move(*on_edges));
  }
  write_result(options, lit, placed, result);
  return close_calculation(context.options, lit,
                           {.start = start,
                            .rays = result.rays,
                            .counted = "sensors",
                            .count = placed.sensors.size(),
                            .out_of_tolerance = result.out_of_tolerance,
                            .error_mean = result.values.mean_error_lux(),
                            .decide = options.decide,
                            .decided = counts_of(result.decided),
                            .regions = result.regions,
                            .findings = result.findings});
}

}  // namespace

CommandBody make_illuminance_command(OptionList& app) {
  const auto options = std::make_shared<IlluminanceCommandOptions>();  // outlives this call
  add_lit_scene_options(app, options->lit);
  add_out_option(app, options->lit);
  add_sensor_options(app, options->sensors);
  app.add_option("--decide", options->decide,
                 "only tell sensors from a value: 300lx in all, or 27%sky, skylight of the open "
                 "field's; those clear of it stop early");
  return [options](const CommandContext& context) { return illuminance(*options, context); };
}

}  // namespace tenku
