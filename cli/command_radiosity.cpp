#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "cli/command.h"
#include "cli/lit_scene_options.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/stopwatch.h"
#include "output/field_writer.h"
#include "output/sensor_file.h"
#include "output/table_writer.h"
#include "radiosity/interior.h"
#include "radiosity/mesh_surfaces.h"
#include "study/radiosity_field.h"
#include "study/work_plane.h"

namespace tenku {
namespace {

struct RadiosityCommandOptions {
  LitSceneOptions lit;
  std::string form_factors = "hemisphere-rays", mesh = "uniform", sensors, watch;
  MeshOptions sizes;
  std::optional<double> work_plane;
  double spacing_m = 0.5, memory_mb = 2048.0;
  int resolution = 32;
  std::size_t most_shots = 0;

  bool wants_sensors() const { return !sensors.empty() || work_plane.has_value(); }
};

bool ends_with(const std::string& text, std::string_view ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

void check_request(const RadiosityCommandOptions& options) {
  if (options.mesh != "uniform") {
    throw InputError("there is no mesh named '" + options.mesh + "'; there is: uniform");
  }
  if (!options.sensors.empty() && options.work_plane) {
    throw InputError("give either --sensors or --work-plane");
  }
  const bool is_table = options.lit.out == "-" || ends_with(options.lit.out, ".csv");
  if (!is_table && !ends_with(options.lit.out, ".vtp")) {
    throw InputError("cannot write '" + options.lit.out + "': the ending must be .csv or .vtp");
  }
  if (is_table != options.wants_sensors()) {
    throw InputError(is_table ? "a table needs --sensors FILE or --work-plane HEIGHT"
                              : "values on sensors go into a table: the ending must be .csv");
  }
  if (!(options.memory_mb >= 0.0)) throw InputError("--memory must not be negative");
  check_can_write(options.lit.out);
}

InteriorOptions interior_options(const RadiosityCommandOptions& options, const LitScene& lit,
                                 const CommonOptions& common) {
  InteriorOptions how;
  how.form_factors = options.form_factors;
  how.shot.resolution = options.resolution;
  how.shot.seed = common.seed;
  how.tolerance_pct = options.lit.tolerance_pct;
  how.most_shots = options.most_shots;
  how.most_bytes = static_cast<std::size_t>(options.memory_mb * 1048576.0);
  how.lift_m = lit.rays().lift_m();
  return how;
}

/// The whole calculation of one scene.
class RadiosityRun {
 public:
  RadiosityRun(const RadiosityCommandOptions& options, const CommandContext& context)
      : options_(options),
        context_(context),
        lit_(load_lit_scene(options.lit, context.progress)),
        mesh_(make_mesh()),
        interior_(mesh_, lit_.scene().materials,
                  with_watch(interior_options(options, lit_, context.options))) {}

  int finish() {
    std::optional<DaylightMethod> daylight;
    if (lit_.source().unobstructed_lux() > 0.0) {
      IlluminanceOptions how = illuminance_options(options_.lit, context_.options);
      how.bounces = 0;
      daylight.emplace(lit_.engines(), lit_.source(), how, light_method(options_.lit));
    }
    light_ = interior_.light(daylight ? &*daylight : nullptr, context_.progress);
    if (options_.wants_sensors()) {
      write_sensors(daylight);
    } else {
      write_vtp(options_.lit.out, field_of_radiosity(lit_, mesh_, interior_, light_));
    }
    return close();
  }

 private:
  ElementMesh make_mesh() {
    const Stopwatch watch;
    context_.progress.begin("mesh", 0);
    const auto& materials = lit_.scene().materials;
    ElementMesh mesh =
        mesh_surfaces(lit_.soup(), materials, chosen_sizes(lit_.soup(), materials, options_.sizes));
    context_.progress.end(std::to_string(mesh.size()) + " elements");
    mesh_s_ = watch.seconds();
    return mesh;
  }

  InteriorOptions with_watch(InteriorOptions how) {
    if (options_.watch.empty()) return how;
    std::filesystem::create_directories(options_.watch);
    how.watch = [this](const ShotView& view) {
      const auto name = fmt::format("shots_{:07}.vtp", view.shots);
      write_vtp(std::filesystem::path(options_.watch) / name,
                field_of_shots(lit_, mesh_, interior_.surfaces(), view));
    };
    return how;
  }

  void write_sensors(const std::optional<DaylightMethod>& daylight) {
    Sensors in_file, sensors;
    if (options_.work_plane) {
      sensors = work_plane(lit_, *options_.work_plane, options_.spacing_m);
      in_file = sensors;
      for (Vec3& at : in_file.position) at = lit_.scene().frame.to_file(at);
    } else {
      in_file = read_sensor_file(options_.sensors);
      sensors = lit_.to_local(in_file);
    }
    SensorIlluminance values(sensors.size());
    if (daylight) {
      const Stopwatch watch;
      IlluminanceResult direct = illuminate(sensors, lit_.engines(), lit_.source(),
                                            daylight->options, daylight->method, context_.progress);
      values = std::move(direct.values);
      daylight_s_ = watch.seconds();
    }
    const Stopwatch watch;
    interior_.add_reflected(sensors, light_, values, context_.progress);
    sensors_s_ = watch.seconds();
    count_missed(values);
    table_of(in_file, values).write(options_.lit.out);
  }

  void count_missed(const SensorIlluminance& values) {
    double mean = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) mean += values.total_lux(i) / values.size();
    const double floor = std::max(0.001 * lit_.source().unobstructed_lux(), 0.01 * mean);
    const ErrorBudget budget(options_.lit.tolerance_pct, floor);
    for (std::size_t i = 0; i < values.size(); ++i) {
      missed_ += values.error_lux[i] > budget.allowed_lux(values.total_lux(i));
    }
  }

  CsvTable table_of(const Sensors& in_file, const SensorIlluminance& values) const {
    const double open = lit_.source().unobstructed_lux();
    const bool has_sun = lit_.source().sun.normal_illuminance > Illuminance(0.0);
    if (!options_.work_plane || has_sun || !(open > 0.0)) {
      return illuminance_table(in_file.position, in_file.normal, values);
    }
    std::vector<double> factor;
    for (std::size_t i = 0; i < values.size(); ++i)
      factor.push_back(100.0 * values.total_lux(i) / open);
    return illuminance_table(in_file.position, in_file.normal, values, {"daylight_factor", factor});
  }

  int close() const {
    std::vector<Finding> findings = lit_.scene().findings;
    for (const auto* more : {&lit_.sky().diagnostics, &light_.findings}) {
      findings.insert(findings.end(), more->begin(), more->end());
    }
    say_findings(context_.options, findings);
    const LightBalance& b = light_.shots.balance;
    say(context_.options,
        fmt::format("{} patches, {} elements, {} shots; emitted {:.6g} lm, absorbed {:.6g}, "
                    "escaped {:.6g}, unshot {:.3g}",
                    mesh_.patches(), mesh_.size(), light_.shots.shots, b.emitted_lm, b.absorbed_lm,
                    b.escaped_lm, b.unshot_lm));
    if (context_.options.json) fmt::print("{}\n", summary().dump(2));
    const bool has_time = options_.most_shots == 0;
    return (has_time && !light_.shots.is_converged) || missed_ > 0 ? kToleranceNotReached : kDone;
  }

  nlohmann::ordered_json summary() const {
    const LightBalance& b = light_.shots.balance;
    const InteriorTimes& times = interior_.times();
    return {{"patches", mesh_.patches()},
            {"elements", mesh_.size()},
            {"vertices", mesh_.vertices.size()},
            {"shots", light_.shots.shots},
            {"sweeps", light_.corners.sweeps},
            {"seconds",
             {{"total_s", watch_.seconds()},
              {"mesh_s", mesh_s_},
              {"daylight_s", times.daylight_s + daylight_s_},
              {"form_factors_s", times.form_factors_s},
              {"solve_s", times.solve_s},
              {"size_field_s", 0.0},
              {"remesh_s", 0.0},
              {"sensors_s", sensors_s_}}},
            {"emitted_lm", b.emitted_lm},
            {"absorbed_lm", b.absorbed_lm},
            {"escaped_lm", b.escaped_lm},
            {"unshot_lm", b.unshot_lm},
            {"left_lm", light_.shots.left_lm},
            {"convergence_lux", light_.corners.convergence_lux},
            {"is_converged", light_.shots.is_converged},
            {"out_of_tolerance", missed_},
            {"sky", lit_.sky().description},
            {"horizontal_lux", lit_.source().unobstructed_lux()}};
  }

  const RadiosityCommandOptions& options_;
  const CommandContext& context_;
  Stopwatch watch_;
  LitScene lit_;
  double mesh_s_ = 0.0, daylight_s_ = 0.0, sensors_s_ = 0.0;
  ElementMesh mesh_;
  Interior interior_;
  InteriorLight light_;
  std::size_t missed_ = 0;
};

void add_radiosity_options(CLI::App& app, RadiosityCommandOptions& o) {
  add_lit_scene_options(app, o.lit);
  app.remove_option(app.get_option("--bounces"));  // all of them are followed
  add_out_option(app, o.lit);
  app.add_option("--form-factors", o.form_factors,
                 "method of the form factors (default hemisphere-rays)");
  app.add_option("--resolution", o.resolution,
                 "of the form factors of a shot: lines or pixels across (default 32)");
  app.add_option("--mesh", o.mesh, "how surfaces are divided: uniform");
  app.add_option("--elements-max", o.sizes.elements_max, "elements not to be passed");
  app.add_option("--size-min", o.sizes.element_min_m, "smallest size of an element, metres");
  app.add_option("--size-max", o.sizes.element_m, "longest edge of an element, metres");
  app.add_option("--patch-size", o.sizes.patch_m, "longest diagonal of a patch, metres");
  app.add_option("--shots", o.most_shots, "stop after so many shots");
  app.add_option("--memory", o.memory_mb,
                 "MiB for form factors that are kept (default 2048); others are found again");
  app.add_option("--sensors", o.sensors,
                 "sensors: x y z nx ny nz a line; - for standard input. Writes a table");
  app.add_option("--work-plane", o.work_plane,
                 "height of a level plane of sensors, in the file's coordinates. Writes a table");
  app.add_option("--spacing", o.spacing_m,
                 "of the sensors of the work plane, metres (default 0.5)");
  app.add_option("--watch", o.watch, "folder for the mesh as it is after 1, 2, 4, 8 ... shots");
}

}  // namespace

CommandBody make_radiosity_command(CLI::App& app) {
  const auto options = std::make_shared<RadiosityCommandOptions>();  // outlives this call
  add_radiosity_options(app, *options);
  return [options](const CommandContext& context) {
    check_request(*options);
    return RadiosityRun(*options, context).finish();
  };
}

}  // namespace tenku
