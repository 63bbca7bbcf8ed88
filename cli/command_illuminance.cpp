#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/lit_scene_options.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "illuminance/illuminate.h"
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

/// Sensors as the file gives them and in the local frame; a grid has a mesh too.
struct Placed {
  std::vector<Vec3> position, normal;  ///< in the coordinates of the scene file
  Sensors sensors;
  std::optional<SensorGrid> grid;
};

Placed place_sensors(const IlluminanceCommandOptions& options, const LitScene& lit) {
  Placed placed;
  if (!options.sensors.empty()) {
    const SensorPoints points = read_sensor_file(options.sensors);
    placed.position = points.position;
    placed.normal = points.normal;
    placed.sensors = lit.to_local({points.position, points.normal});
    return placed;
  }
  placed.grid = lit.grid(words_of(options.grid), options.spacing_m);
  placed.sensors = placed.grid->sensors;
  for (std::size_t i = 0; i < placed.sensors.size(); ++i) {
    placed.position.push_back(lit.scene().frame.to_file(placed.sensors.position[i]));
    placed.normal.push_back(placed.sensors.normal[i]);
  }
  return placed;
}

void write_result(const IlluminanceCommandOptions& options, const LitScene& lit,
                  const Placed& placed, const IlluminanceResult& result) {
  if (!ends_with(options.lit.out, ".vtp")) {
    illuminance_table(placed.position, placed.normal, result.values).write(options.lit.out);
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
  const IlluminanceResult result =
      illuminate(placed.sensors, lit.rays(), lit.source(), how, context.progress);
  write_result(options, lit, placed, result);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::vector<Finding> findings = lit.scene().findings;
  findings.insert(findings.end(), lit.sky().diagnostics.begin(), lit.sky().diagnostics.end());
  findings.insert(findings.end(), result.findings.begin(), result.findings.end());
  say_findings(context.options, findings);
  if (context.options.json) {
    const nlohmann::ordered_json summary{{"seconds", seconds},
                                         {"rays", result.rays},
                                         {"depth_maps", 0},
                                         {"elements", 0},
                                         {"sensors", placed.sensors.size()},
                                         {"error_mean", mean_error(result.values)},
                                         {"out_of_tolerance", result.out_of_tolerance},
                                         {"sky", lit.sky().description},
                                         {"horizontal_lux", lit.source().unobstructed_lux()}};
    fmt::print("{}\n", summary.dump(2));
  }
  return result.out_of_tolerance > 0 ? kToleranceNotReached : kDone;
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
