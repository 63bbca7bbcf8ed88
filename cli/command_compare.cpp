#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/lit_scene_options.h"
#include "cli/option_list.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "output/image_writer.h"
#include "output/table_writer.h"
#include "study/map_results.h"
#include "study/scene_comparison.h"
#include "study/scene_reflection.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

struct CompareOptions {
  LitSceneOptions lit;
  std::string with, with_lod;
  double spacing_m = 2.0;
};

LitSceneOptions second_of(const CompareOptions& options) {
  LitSceneOptions second = options.lit;
  if (!options.with.empty()) second.scene.scene = options.with;
  if (!options.with_lod.empty()) second.scene.building_lod = options.with_lod;
  return second;
}

void check_request(const CompareOptions& options) {
  if (options.with.empty() && options.with_lod.empty()) {
    throw InputError("give --with, another scene, or --with-lod, another level of detail");
  }
  if (!(options.spacing_m > 0.0) || !std::isfinite(options.spacing_m)) {
    throw InputError(fmt::format("--spacing {}: must be positive", options.spacing_m));
  }
}

std::string table_of(const std::vector<ComparisonRow>& rows) {
  constexpr const char* kLine =
      "{:<22} {:>9} {:>8} {:>8} {:>8} {:>8} {:>7} {:>7} {:>7} {:>7} {:>9}";
  std::string text = fmt::format(kLine, "ground", "squares", "mean", "median", "95 %", "worst",
                                 "<= 2 %", "<= 5 %", "<= 10 %", "<= 20 %", "sun off");
  const auto percent = [](double value) { return fmt::format("{:.3g} %", value); };
  for (const ComparisonRow& row : rows) {
    if (row.squares == 0) continue;
    text.push_back('\n');
    text += fmt::format(kLine, row.which, row.squares, fmt::format("{:+.3g} %", row.mean_pct),
                        percent(row.median_pct), percent(row.p95_pct), percent(row.worst_pct),
                        percent(100.0 * row.within[0]), percent(100.0 * row.within[1]),
                        percent(100.0 * row.within[2]), percent(100.0 * row.within[3]),
                        percent(100.0 * row.sun_differs));
  }
  return text;
}

nlohmann::ordered_json json_of(const SceneComparison& made,
                               const std::vector<ComparisonRow>& rows) {
  nlohmann::ordered_json table = nlohmann::ordered_json::array();
  for (const ComparisonRow& row : rows) {
    nlohmann::ordered_json within;
    for (std::size_t p = 0; p < kWithin_pct.size(); ++p) {
      within[fmt::format("{:g}", kWithin_pct[p])] = row.within[p];
    }
    table.push_back({{"which", row.which},
                     {"squares", row.squares},
                     {"mean_pct", row.mean_pct},
                     {"median_pct", row.median_pct},
                     {"p95_pct", row.p95_pct},
                     {"worst_pct", row.worst_pct},
                     {"within", within},
                     {"sun_differs", row.sun_differs}});
  }
  double error = 0.0;
  for (const double e : made.error_pct) error += e / static_cast<double>(made.error_pct.size());
  return {{"cell_m", made.plan.grid.cell_m},
          {"squares", made.difference_pct.size()},
          {"covered_in_second", made.covered},
          {"mean_error_pct", error},
          {"table", table}};
}

CsvTable csv_of(const SceneComparison& made, const LitScene& lit) {
  CsvTable table(
      "x,y,z,total_lux,error_lux,other_total_lux,other_error_lux,difference_pct,error_pct,sky_view,"
      "other_sky_view");
  for (std::size_t k = 0; k < made.plan.sensors.size(); ++k) {
    const Vec3 at = lit.scene().map_frame.to_file(made.plan.sensors.position[k]);
    table.add(at.x).add(at.y).add(at.z);
    table.add(made.first.total_lux(k)).add(made.first.error_lux[k]);
    table.add(made.second.total_lux(k)).add(made.second.error_lux[k]);
    table.add(made.difference_pct[k]).add(made.error_pct[k]);
    table.add(made.first.sky_view[k]).add(made.second.sky_view[k]);
    table.end_row();
  }
  return table;
}

/// The same squares for GIS programs.
MapRaster raster_of(const SceneComparison& made, const LitScene& lit) {
  MapRaster raster = raster_of_squares(lit, made.plan.grid);
  const auto add = [&](const char* name, const char* unit, const auto& value) {
    MapRaster::Band band{name, unit,
                         std::vector<float>(raster.rows * raster.columns, std::nanf(""))};
    for (std::size_t k = 0; k < made.plan.cell.size(); ++k) {
      band.values[made.plan.cell[k]] = static_cast<float>(value(k));
    }
    raster.bands.push_back(std::move(band));
  };
  add("difference_pct", "%", [&](std::size_t k) { return made.difference_pct[k]; });
  add("error_pct", "%", [&](std::size_t k) { return made.error_pct[k]; });
  add("total_lux", "lx", [&](std::size_t k) { return made.first.total_lux(k); });
  add("other_total_lux", "lx", [&](std::size_t k) { return made.second.total_lux(k); });
  return raster;
}

Image8 picture_of(const SceneComparison& made, const ComparisonRow& all,
                  const CompareOptions& options) {
  PlanMap map;
  map.title = "Where the other model is enough";
  map.caption =
      fmt::format("{}. Squares of {:.3g} m that are open in both; 95 % of them within {:.3g} %.",
                  options.with.empty() ? "Level of detail " + options.with_lod
                                       : fs::path(options.with).filename().string(),
                  made.plan.grid.cell_m, all.p95_pct);
  map.quantity = "Difference of the illuminance on the ground";
  map.unit = "%";
  map.grid = made.plan.grid;
  map.buildings = made.plan.buildings;
  map.scale = ValueScale{0.0, 20.0};
  return plan_map(map);
}

int compare(const CompareOptions& options, const CommandContext& context) {
  check_request(options);
  const fs::path folder = options.lit.out;
  const LitScene first = load_lit_scene(options.lit, context.progress);
  const LitScene second = load_lit_scene(second_of(options), context.progress);
  const IlluminanceOptions how = illuminance_options(options.lit, context.options);
  const LightMethod method = light_method(options.lit);
  SceneReflection of_first(first, reflection_named(options.lit.reflection));
  SceneReflection of_second(second, reflection_named(options.lit.reflection));
  const SceneComparison made =
      compare_scenes({first, of_first.finder(how, method)}, {second, of_second.finder(how, method)},
                     how, method, options.spacing_m, context.progress);
  const std::vector<ComparisonRow> rows = comparison_table(made);
  fs::create_directories(folder);
  csv_of(made, first).write(folder / "difference.csv");
  write_png(folder / "difference.png", picture_of(made, rows.front(), options));
  AtomicFile raster(folder / "difference.tif");
  map_writer().write_raster(raster.path(), raster_of(made, first));
  raster.commit();
  say_findings(context.options, first.scene().findings);
  if (context.options.json) {
    fmt::print("{}\n", json_of(made, rows).dump(2));
  } else {
    fmt::print("{}\n", table_of(rows));
  }
  say(context.options, fmt::format("{} squares of {:.3g} m; {} more are covered in the other model",
                                   made.plan.sensors.size(), made.plan.grid.cell_m, made.covered));
  return kDone;
}

}  // namespace

CommandBody make_compare_command(OptionList& app) {
  const auto options = std::make_shared<CompareOptions>();  // outlives this call
  add_lit_scene_options(app, options->lit);
  app.add_option("--with", options->with, "another model of the same place");
  app.add_option("--with-lod", options->with_lod,
                 "level of detail of the other model, such as 1 (with --with: of that file)");
  app.add_option("--spacing", options->spacing_m, "side of the squares, metres (default 2)");
  app.add_option("--out", options->lit.out,
                 "folder for difference.png, difference.csv and difference.tif")
      .required();
  return [options](const CommandContext& context) { return compare(*options, context); };
}

}  // namespace tenku
