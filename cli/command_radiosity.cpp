#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "cli/command.h"
#include "cli/lit_scene_options.h"
#include "cli/mesh_options.h"
#include "cli/option_list.h"
#include "cli/sky_rows.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/processor_watch.h"
#include "core/stopwatch.h"
#include "meshing/mesh_surfaces.h"
#include "output/field_writer.h"
#include "output/sensor_file.h"
#include "output/table_writer.h"
#include "radiosity/interior.h"
#include "study/radiosity_field.h"
#include "study/work_plane.h"
#include "visibility/crossing_faces.h"

namespace tenku {
namespace {

struct RadiosityCommandOptions {
  LitSceneOptions lit;
  RadiosityMeshOptions mesh;
  std::string form_factors = "hemisphere-rays", sensors, watch, skies;
  std::optional<double> work_plane;
  double spacing_m = 0.5, memory_mb = 2048.0;
  int resolution = 32;
  std::size_t most_shots = 0;

  bool wants_sensors() const { return !sensors.empty() || work_plane.has_value(); }
};

void check_request(const RadiosityCommandOptions& options) {
  check_mesh_options(options.mesh);
  if (!options.sensors.empty() && options.work_plane) {
    throw InputError("give either --sensors or --work-plane");
  }
  const bool is_table = options.lit.out == "-" || options.lit.out.ends_with(".csv");
  if (!is_table && !options.lit.out.ends_with(".vtp")) {
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

/// One light of the calculation, and what became of it.
struct LightRun {
  std::string sky;
  double open_lux = 0.0;  ///< of the unobstructed horizontal plane
  bool has_sun = false;
  InteriorLight light;
  double seconds = 0.0, daylight_s = 0.0, processor_s = 0.0;
};

nlohmann::ordered_json json_of_rounds(const MeshLoop& loop) {
  auto rounds = nlohmann::ordered_json::array();
  for (const MeshRound& round : loop.rounds()) {
    rounds.push_back({{"elements", round.elements},
                      {"polygons_meshed", round.polygons_meshed},
                      {"points_kept", round.points_kept},
                      {"missed_pct", round.missed_pct}});
    if (round.quality.edges == 0) continue;
    rounds.back()["mean_smallest_angle_deg"] = round.quality.mean_smallest_angle_deg;
    rounds.back()["least_angle_deg"] = round.quality.least_angle_deg;
    rounds.back()["edges_within_20_pct"] = round.quality.share_within_20_pct;
  }
  return rounds;
}

/// The whole calculation of one scene.
class RadiosityRun {
 public:
  RadiosityRun(const RadiosityCommandOptions& options, const CommandContext& context)
      : options_(options),
        context_(context),
        rows_(options.skies.empty()
                  ? std::vector<SkyRow>{{options.lit.site, options.lit.sky, 1.0}}
                  : read_sky_rows(options.skies, options.lit.site, options.lit.sky)),
        lit_(load_lit_scene(as_in_first_row(options.lit, rows_), context.progress)),
        loop_(make_mesh()),
        sensor_daylight_(rows_.size() > 1) {}

  int finish() {
    if (options_.wants_sensors()) place_sensors();
    for (const SkyRow& row : rows_) solve(row);
    if (table_) table_->write(options_.lit.out);
    return close();
  }

 private:
  static LitSceneOptions as_in_first_row(LitSceneOptions lit, const std::vector<SkyRow>& rows) {
    lit.site = rows.front().site;
    lit.sky = rows.front().sky;
    return lit;
  }

  std::unique_ptr<MeshLoop> make_mesh() {
    const Stopwatch watch;
    context_.progress.begin("mesh", 0);
    const InteriorOptions how = with_watch(interior_options(options_, lit_, context_.options));
    auto loop = make_mesh_loop(lit_, options_.mesh, how, mesh_findings_);
    context_.progress.end(std::to_string(loop->mesh().size()) + " elements");
    mesh_s_ = watch.seconds();
    return loop;
  }

  const ElementMesh& mesh() const { return loop_->mesh(); }
  Interior& interior() { return loop_->interior(); }

  InteriorOptions with_watch(InteriorOptions how) {
    how.many_skies = rows_.size() > 1;
    if (options_.watch.empty()) return how;
    std::filesystem::create_directories(options_.watch);
    how.watch = [this](const ShotView& view) {
      const auto name = fmt::format("shots_{:07}.vtp", view.shots);
      write_vtp(std::filesystem::path(options_.watch) / name,
                field_of_shots(lit_, mesh(), interior().surfaces(), view));
    };
    return how;
  }

  void place_sensors() {
    if (options_.work_plane) {
      sensors_ = work_plane(lit_, *options_.work_plane, options_.spacing_m);
      in_file_ = lit_.to_file(sensors_);
    } else {
      in_file_ = read_sensor_file(options_.sensors);
      sensors_ = lit_.to_local(in_file_);
    }
  }

  /// The first light is what the mesh is made for.
  InteriorLight light(const LightRequest& request) {
    if (!runs_.empty()) return interior().light(request, context_.progress);
    loop_->run(request, context_.progress);
    if (!options_.mesh.report.empty()) {
      write_mesh_report(lit_, options_.mesh, interior_options(options_, lit_, context_.options),
                        *loop_, request, context_.progress);
    }
    const Stopwatch watch;
    if (options_.wants_sensors()) look_ = interior().look_from(sensors_);
    sensors_s_ += watch.seconds();
    return loop_->light();
  }

  void solve(const SkyRow& row) {
    const Stopwatch watch;
    const ProcessorWatch processor;
    LightRun run;
    Sky sky = resolve_sky(row.site, row.sky, lit_.site());
    const DaylightSource source = daylight_of(sky);
    run.sky = sky.description;
    run.open_lux = source.unobstructed_lux();
    run.has_sun = source.sun.normal_illuminance > Illuminance(0.0);
    IlluminanceOptions how = illuminance_options(options_.lit, context_.options);
    how.bounces = 0;
    const DaylightMethod daylight{lit_.engines(), source, how, light_method(options_.lit)};
    const double before = loop_->times().daylight_s;
    const LightRequest request{run.open_lux > 0.0 ? &daylight : nullptr, row.lamp_scale};
    run.light = light(request);
    run.daylight_s = loop_->times().daylight_s - before;
    if (options_.wants_sensors()) {
      add_to_table(run, daylight);
    } else {
      write_vtp(field_file(),
                field_of_radiosity(lit_, mesh(), interior(), run.light, loop_->asked_size_m()));
    }
    run.light.findings.insert(run.light.findings.end(), sky.diagnostics.begin(),
                              sky.diagnostics.end());
    run.seconds = watch.seconds();
    run.processor_s = processor.seconds();
    runs_.push_back(std::move(run));
  }

  /// With a table of skies one file a row: `F.vtp` becomes `F_0001.vtp`.
  std::filesystem::path field_file() const {
    const std::filesystem::path out = options_.lit.out;
    if (options_.skies.empty()) return out;
    return out.parent_path() / fmt::format("{}_{:04}.vtp", out.stem().string(), runs_.size() + 1);
  }

  void add_to_table(LightRun& run, const DaylightMethod& daylight) {
    SensorIlluminance values(sensors_.size());
    const Stopwatch watch;
    if (run.open_lux > 0.0) {
      values = sensor_daylight_.light(sensors_, daylight, context_.progress).values;
    }
    interior().add_reflected(look_, run.light, values, context_.progress);
    sensors_s_ += watch.seconds();
    count_missed(values, run.open_lux);
    const bool has_factor = options_.work_plane.has_value();
    if (!table_) {
      table_.emplace((options_.skies.empty() ? "" : "row,") + std::string(kIlluminanceHeader) +
                     (has_factor ? ",daylight_factor" : ""));
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!options_.skies.empty()) table_->add(static_cast<double>(runs_.size() + 1));
      add_illuminance(*table_, {in_file_.position[i], in_file_.normal[i]}, values, i);
      if (has_factor) table_->add(daylight_factor(run, values.total_lux(i)));
      table_->end_row();
    }
  }

  /// In percent; none under a sun, or without a sky.
  static double daylight_factor(const LightRun& run, double lux) {
    if (run.has_sun || !(run.open_lux > 0.0)) return std::numeric_limits<double>::quiet_NaN();
    return 100.0 * lux / run.open_lux;
  }

  void count_missed(const SensorIlluminance& values, double open_lux) {
    double mean = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      mean += values.total_lux(i) / static_cast<double>(values.size());
    }
    const ErrorBudget budget(options_.lit.tolerance_pct, std::max(0.001 * open_lux, 0.01 * mean));
    for (std::size_t i = 0; i < values.size(); ++i) {
      missed_ += values.error_lux[i] > budget.allowed_lux(values.total_lux(i));
    }
  }

  int close() const {
    std::vector<Finding> findings = lit_.scene().findings;
    findings.insert(findings.end(), mesh_findings_.begin(), mesh_findings_.end());
    if (auto crossing = crossing_faces(lit_.scene(), lit_.engines().rays())) {
      findings.push_back(std::move(*crossing));
    }
    if (auto on_edges = sensors_on_edges(sensors_, lit_.engines().rays())) {
      findings.push_back(std::move(*on_edges));
    }
    bool is_converged = is_fine_enough(*loop_, options_.mesh, options_.lit.tolerance_pct, findings);
    for (const LightRun& run : runs_) {
      findings.insert(findings.end(), run.light.findings.begin(), run.light.findings.end());
      is_converged &= run.light.shots.is_converged || options_.most_shots > 0;
    }
    say_findings(context_.options, findings);
    const LightBalance& b = runs_.front().light.shots.balance;
    say(context_.options,
        fmt::format("{} patches, {} elements, {} shots; emitted {:.6g} lm, absorbed {:.6g}, "
                    "escaped {:.6g}, unshot {:.3g}",
                    mesh().patches(), mesh().size(), runs_.front().light.shots.shots, b.emitted_lm,
                    b.absorbed_lm, b.escaped_lm, b.unshot_lm));
    if (context_.options.json) fmt::print("{}\n", summary().dump(2));
    return !is_converged || missed_ > 0 ? kToleranceNotReached : kDone;
  }

  static nlohmann::ordered_json json_of_light(const LightRun& run) {
    const LightBalance& b = run.light.shots.balance;
    return {{"sky", run.sky},
            {"horizontal_lux", run.open_lux},
            {"shots", run.light.shots.shots},
            {"sweeps", run.light.corners.sweeps},
            {"emitted_lm", b.emitted_lm},
            {"absorbed_lm", b.absorbed_lm},
            {"escaped_lm", b.escaped_lm},
            {"unshot_lm", b.unshot_lm},
            {"left_lm", run.light.shots.left_lm},
            {"convergence_lux", run.light.corners.convergence_lux},
            {"is_converged", run.light.shots.is_converged}};
  }

  nlohmann::ordered_json summary() const {
    const InteriorTimes times = loop_->times();
    nlohmann::ordered_json json{{"patches", mesh().patches()},
                                {"elements", mesh().size()},
                                {"vertices", mesh().vertices.size()},
                                {"seconds",
                                 {{"total_s", watch_.seconds()},
                                  {"mesh_s", mesh_s_},
                                  {"daylight_s", times.daylight_s},
                                  {"form_factors_s", times.form_factors_s},
                                  {"solve_s", times.solve_s},
                                  {"size_field_s", loop_->size_field_s()},
                                  {"remesh_s", loop_->remesh_s()},
                                  {"sensors_s", sensors_s_}}},
                                {"form_factor_bytes", loop_->interior().bytes()},
                                {"out_of_tolerance", missed_},
                                {"rounds", json_of_rounds(*loop_)}};
    json.update(json_of_light(runs_.front()));
    if (options_.skies.empty()) return json;
    for (const LightRun& run : runs_) {
      nlohmann::ordered_json one = json_of_light(run);
      one["seconds"] = run.seconds;
      one["daylight_s"] = run.daylight_s;
      one["processor_s"] = run.processor_s;
      json["skies"].push_back(std::move(one));
    }
    return json;
  }

  const RadiosityCommandOptions& options_;
  const CommandContext& context_;
  Stopwatch watch_;
  std::vector<SkyRow> rows_;
  LitScene lit_;
  double mesh_s_ = 0.0, sensors_s_ = 0.0;
  std::vector<Finding> mesh_findings_;
  std::unique_ptr<MeshLoop> loop_;
  Sensors in_file_, sensors_;
  InteriorSensors look_;
  KeptDaylight sensor_daylight_;
  std::optional<CsvTable> table_;
  std::vector<LightRun> runs_;
  std::size_t missed_ = 0;
};

void add_radiosity_options(OptionList& app, RadiosityCommandOptions& o) {
  add_lit_scene_options(app, o.lit);
  app.remove_option("--bounces");  // all of them are followed
  add_out_option(app, o.lit);
  app.add_option("--form-factors", o.form_factors,
                 "method of the form factors (default hemisphere-rays)");
  app.add_option("--resolution", o.resolution,
                 "of the form factors of a shot: lines or pixels across (default 32)");
  add_mesh_options(app, o.mesh);
  app.add_option("--shots", o.most_shots, "stop after so many shots");
  app.add_option("--memory", o.memory_mb,
                 "MiB for form factors that are kept (default 2048); others are found again");
  app.add_option("--sensors", o.sensors,
                 "sensors: x y z nx ny nz a line; - for standard input. Writes a table");
  app.add_option("--work-plane", o.work_plane,
                 "height of a level plane of sensors, in the file's coordinates. Writes a table");
  app.add_option("--spacing", o.spacing_m,
                 "of the sensors of the work plane, metres (default 0.5)");
  app.add_option("--skies", o.skies,
                 "table of skies, suns, hours and lamps, solved with one set of form factors");
  app.add_option("--watch", o.watch, "folder for the mesh as it is after 1, 2, 4, 8 ... shots");
}

}  // namespace

CommandBody make_radiosity_command(OptionList& app) {
  const auto options = std::make_shared<RadiosityCommandOptions>();  // outlives this call
  add_radiosity_options(app, *options);
  return [options](const CommandContext& context) {
    check_request(*options);
    return RadiosityRun(*options, context).finish();
  };
}

}  // namespace tenku
