#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>

#include "cli/command.h"
#include "cli/lit_scene_options.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "illuminance/planned_light.h"
#include "output/field_writer.h"
#include "output/sensor_file.h"
#include "output/table_writer.h"
#include "study/illuminance_field.h"

namespace tenku {
namespace {

struct IlluminanceCommandOptions {
  LitSceneOptions lit;
  std::string sensors, grid;
  double spacing_m = 1.0;
};

std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    if (end > begin) words.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

bool ends_with(const std::string& text, std::string_view ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

void check_request(const IlluminanceCommandOptions& options) {
  if (options.sensors.empty() == options.grid.empty()) {
    throw InputError("give either --sensors FILE or --grid SURFACES --spacing M");
  }
  const bool table = options.lit.out == "-" || ends_with(options.lit.out, ".csv");
  if (!table && !ends_with(options.lit.out, ".vtp")) {
    throw InputError("cannot write '" + options.lit.out + "': the ending must be .csv or .vtp");
  }
  check_can_write(options.lit.out);
}

/// Sensors in the coordinates of the scene file and in the local frame; a grid has a mesh too.
struct Placed {
  Sensors in_file, sensors;
  std::optional<SensorGrid> grid;
};

Placed place_sensors(const IlluminanceCommandOptions& options, const LitScene& lit) {
  Placed placed;
  if (!options.sensors.empty()) {
    placed.in_file = read_sensor_file(options.sensors);
    placed.sensors = lit.to_local(placed.in_file);
    return placed;
  }
  placed.grid = lit.grid(words_of(options.grid), options.spacing_m);
  placed.sensors = placed.grid->sensors;
  placed.in_file = placed.sensors;
  for (Vec3& position : placed.in_file.position) position = lit.scene().frame.to_file(position);
  return placed;
}

void write_result(const IlluminanceCommandOptions& options, const LitScene& lit,
                  const Placed& placed, const IlluminanceResult& result) {
  if (!ends_with(options.lit.out, ".vtp")) {
    illuminance_table(placed.in_file.position, placed.in_file.normal, result.values)
        .write(options.lit.out);
    return;
  }
  FieldMesh mesh = placed.grid ? field_of_grid(lit, *placed.grid, result.values)
                               : field_of_points(lit, placed.sensors, result.values);
  write_vtp(options.lit.out, mesh);
}

double mean_error(const SensorIlluminance& values) {
  double sum = 0.0;
  for (const double error : values.error_lux) sum += error;
  return values.size() > 0 ? sum / static_cast<double>(values.size()) : 0.0;
}

int illuminance(const IlluminanceCommandOptions& options, const CommandContext& context) {
  check_request(options);
  const auto start = std::chrono::steady_clock::now();
  const LitScene lit = load_lit_scene(options.lit, context.progress);
  const Placed placed = place_sensors(options, lit);
  IlluminanceOptions how;
  how.tolerance_pct = options.lit.tolerance_pct;
  how.bounces = options.lit.bounces;
  how.seed = context.options.seed;
  const IlluminanceResult result = illuminate(placed.sensors, lit.engines(), lit.source(), how,
                                              light_method(options.lit), context.progress);
  write_result(options, lit, placed, result);
  return close_calculation(context.options, lit,
                           {.start = start,
                            .rays = result.rays,
                            .counted = "sensors",
                            .count = placed.sensors.size(),
                            .out_of_tolerance = result.out_of_tolerance,
                            .error_mean = mean_error(result.values),
                            .regions = result.regions,
                            .findings = result.findings});
}

}  // namespace

CommandBody make_illuminance_command(CLI::App& app) {
  const auto options = std::make_shared<IlluminanceCommandOptions>();  // outlives this call
  add_lit_scene_options(app, options->lit);
  app.add_option("--sensors", options->sensors,
                 "sensors: x y z nx ny nz a line; - for standard input");
  app.add_option("--grid", options->grid, "surfaces to cover: ground,roofs,walls");
  app.add_option("--spacing", options->spacing_m, "of the grid, metres (default 1)");
  return [options](const CommandContext& context) { return illuminance(*options, context); };
}

}  // namespace tenku
