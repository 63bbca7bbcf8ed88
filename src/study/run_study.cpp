#include "study/run_study.h"

#include <fmt/format.h>

#include <cmath>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/stopwatch.h"
#include "illuminance/expected_time.h"
#include "illuminance/wide_texels.h"
#include "output/field_writer.h"
#include "output/sensor_file.h"
#include "output/table_writer.h"
#include "reports/report.h"
#include "study/ground_plan.h"
#include "study/illuminance_field.h"
#include "study/lit_scene.h"
#include "study/scene_reflection.h"
#include "study/stage_clock.h"
#include "study/study_report.h"
#include "study/study_sky.h"
#include "study/time_limit.h"
#include "study/view_output.h"
#include "view/background.h"
#include "view/eye_inside.h"
#include "view/view_render.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

constexpr double kWiden = 1.5;  // the spacing, as long as there are too many sensors
constexpr double kWidest_m = 1000.0;
constexpr double kShare = 4.0;  // spacings over which sensors on a surface share reflected light

ReadOptions read_options_of(const Study& study) {
  const StudyScene& scene = study.scene;
  ReadOptions options;
  options.tolerance_pct = study.calculation.tolerance_percent;
  options.building_lod = scene.building_lod;
  options.materials = scene.materials;
  options.crs = scene.crs;
  options.ground = GroundChoice::parse(scene.ground);
  options.terrain = scene.terrain;
  options.on_terrain = on_terrain_named(scene.on_terrain);
  options.around = scene.around;
  options.up = scene.up == "y" ? UpAxis::Y : scene.up == "z" ? UpAxis::Z : UpAxis::ByFormat;
  options.scale = scene.scale;
  options.rotate = scene.rotate;
  options.site = scene.site;
  return options;
}

IlluminanceOptions illuminance_options_of(const StudyCalculation& calculation) {
  IlluminanceOptions options;
  options.tolerance_pct = calculation.tolerance_percent;
  options.bounces = calculation.bounces;
  options.seed = calculation.seed;
  return options;
}

LightMethod method_of(const StudyCalculation& calculation) {
  LightMethod method;
  method.engine = calculation.engine;
  method.detail = calculation.detail;
  method.mu = calculation.mu;
  return method;
}

ViewRequest view_request_of(const StudyView& view, const Study& study, const LitScene& lit) {
  ViewRequest request;
  request.view.width = view.size[0];
  request.view.height = view.size[1];
  request.view.horizontal_fov = view.field_of_view;
  request.tolerance_pct = study.calculation.tolerance_percent;
  request.bounces = study.calculation.bounces;
  request.seed = study.calculation.seed;
  request.method = method_of(study.calculation);
  request.mirrors = view.mirrors;
  if (view.eye && view.target) {
    request.view.eye = lit.scene().frame.to_local(*view.eye);
    request.view.target = lit.scene().frame.to_local(*view.target);
  } else {
    place_overview(lit, request.view);
  }
  return request;
}

void add(std::optional<Finding> finding, std::vector<Finding>& findings) {
  if (finding) findings.push_back(std::move(*finding));
}

/// Each step of a study: what it makes goes into a file and into the report.
class StudyRun {
 public:
  StudyRun(const Study& study, const fs::path& folder, Progress& progress)
      : study_(study),
        folder_(folder),
        progress_(progress),
        lit_(
            study.scene.file, read_options_of(study),
            [&](const std::optional<Location>& scene_site) {
              moment_ = moment_of(study, scene_site);
              return sky_of(study, moment_);
            },
            study.calculation.partition, study.calculation.gl, progress_),
        reflection_(lit_, study.calculation.reflection),
        report_(study_, lit_, moment_) {}

  void render(const StudyView& view) {
    ViewRequest request = view_request_of(view, study_, lit_);
    std::unique_ptr<Background> background;
    if (!view.background.empty()) {
      background = read_background(view.background, view.background_white);
      request.background = background.get();
    }
    request.reflection =
        reflection_.finder(illuminance_options_of(study_.calculation), request.method);
    RenderedView picture =
        render_view(request, lit_.engines(), lit_.source(), lit_.sky().model.get(), progress_);
    reflection_.tell(picture.findings);
    add(eye_inside(request.view.eye, lit_.scene(), lit_.rays()), picture.findings);
    add(wide_texels(picture.regions, lit_.scene().frame), picture.findings);
    for (const std::string& format : view.formats) {
      write_view(place(view.name + "." + format), picture, view.show,
                 {.title = report_.title(), .time = report_.time_text(), .units = {}});
    }
    outcome_.out_of_tolerance += picture.out_of_tolerance;
    report_.add_view(picture, view);
  }

  /// Sensors of a field, and how far apart they are.
  struct PlacedField {
    SensorGrid grid;
    double spacing_m;
  };

  /// Seconds that the study is expected to take at a tolerance.
  double expected_s(double tolerance_pct, const std::vector<PlacedField>& fields) const {
    Study study = study_;
    study.calculation.tolerance_percent = tolerance_pct;
    const LightMethod method = method_of(study.calculation);
    SceneReflection reflection(lit_, study.calculation.reflection);
    double sum = 0.0;
    const auto add_light = [&](const Sensors& sensors, double share_m) {
      const IlluminanceOptions options = options_with(study.calculation, reflection, share_m);
      sum += expected_light_s(sensors, lit_.engines(), lit_.source(), options, method);
    };
    for (const PlacedField& field : fields) {
      add_light(field.grid.sensors, kShare * field.spacing_m);
    }
    for (const StudySensors& file : study.sensors) {
      add_light(lit_.to_local(read_sensor_file(file.file)), 0.0);
    }
    if (study.plan) {
      const GroundPlan ground = ground_plan(lit_, study.plan->spacing_m);
      add_light(ground.sensors, kShare * ground.grid.cell_m);
    }
    for (const StudyView& view : study.views) sum += expected_view_s(view, study, reflection);
    return sum;
  }

  /// Chooses the tolerance of the study.
  /// @return whether the time allows any
  bool keep_within(double left_s, const std::vector<PlacedField>& fields) {
    const TimedTolerance chosen = tolerance_within(
        [&](double tolerance_pct) { return expected_s(tolerance_pct, fields); }, left_s, progress_);
    study_.calculation.tolerance_percent = chosen.tolerance_pct;
    report_.note(chosen.why);
    return chosen.is_reachable;
  }

  /// Sensors of each field, which may not exist: before the long work.
  std::vector<PlacedField> place_sensors() {
    std::vector<PlacedField> placed;
    for (const StudyField& field : study_.fields) {
      double spacing = field.spacing_m;
      SensorGrid grid = lit_.grid(field.surfaces, spacing);
      while (grid.sensors.size() > field.most_sensors && spacing < kWidest_m) {
        spacing *= kWiden;
        grid = lit_.grid(field.surfaces, spacing);
      }
      if (spacing > field.spacing_m) {
        report_.note(fmt::format(
            "the sensors of '{}' are {:.3g} m apart, not {:.3g} m, which would be over {} of them",
            field.name, spacing, field.spacing_m, field.most_sensors));
      }
      placed.push_back({std::move(grid), spacing});
    }
    return placed;
  }

  void illuminate_surfaces(const StudyField& field, const PlacedField& placed) {
    const IlluminanceResult result =
        light(placed.grid.sensors, kShare * placed.spacing_m, "'" + field.name + "'");
    FieldMesh mesh = field_of_grid(lit_, placed.grid, result.values, result.decided);
    mesh.texts.push_back({"time", {report_.time_text()}});
    write_vtp(place(field.name + ".vtp"), mesh);
    report_.add_field(placed.grid, result.values);
  }

  void illuminate_sensors(const StudySensors& sensors) {
    const Sensors points = read_sensor_file(sensors.file);
    const IlluminanceResult result = light(lit_.to_local(points), 0.0, "'" + sensors.name + "'");
    illuminance_table(points.position, points.normal, result.values, result.decided)
        .write(place(sensors.name + ".csv"));
  }

  void map_ground(const StudyPlan& plan) {
    GroundPlan ground = ground_plan(lit_, plan.spacing_m);
    if (ground.sensors.size() == 0) return report_.note("the plan was left out: no open ground");
    const IlluminanceResult result = light(ground.sensors, kShare * ground.grid.cell_m, "the plan");
    ground.fill(result.values);
    const Image8 map = plan_map(report_.plan_of(ground, result.values, plan));
    write_png(place("plan.png"), map,
              {.title = report_.title(), .time = report_.time_text(), .units = {}});
    report_.add_plan(map);
  }

  StudyOutcome finish() {
    if (const std::string sun_path = report_.sun_path(); !sun_path.empty()) {
      write_whole_file(place("sun_path.svg"), sun_path);
    }
    if (study_.report) write_whole_file(place("report.html"), report_html(report_.content()));
    const fs::path manifest = place("manifest.json");
    write_manifest(manifest, report_.manifest(outcome_.files, progress_.stages()));
    outcome_.tolerance_pct = study_.calculation.tolerance_percent;
    outcome_.findings = report_.findings();
    return outcome_;
  }

 private:
  /// @param what  the sensors, in words
  IlluminanceResult light(const Sensors& sensors, double share_reflected_m,
                          const std::string& what) {
    const IlluminanceOptions options =
        options_with(study_.calculation, reflection_, share_reflected_m);
    IlluminanceResult result = illuminate(sensors, lit_.engines(), lit_.source(), options,
                                          method_of(study_.calculation), progress_);
    reflection_.tell(result.findings);
    add(wide_texels(result.regions, lit_.scene().frame), result.findings);
    outcome_.out_of_tolerance += result.out_of_tolerance;
    report_.add_light(result);
    if (!study_.calculation.decide.empty()) {
      report_.note(in_words(study_.calculation.decide, counts_of(result.decided)) + " of " + what);
    }
    return result;
  }

  static IlluminanceOptions options_with(const StudyCalculation& calculation,
                                         SceneReflection& reflection, double share_reflected_m) {
    IlluminanceOptions options = illuminance_options_of(calculation);
    if (calculation.decide.empty()) {
      options.share_reflected_m = share_reflected_m;
    } else {
      options.decide = decision_threshold(calculation.decide);
    }
    options.reflection = reflection.finder(options, method_of(calculation));
    return options;
  }

  /// By radiosity the solution is found for one sensor; looking it up for each pixel is not in it.
  double expected_view_s(const StudyView& view, const Study& study,
                         SceneReflection& reflection) const {
    ViewRequest request = view_request_of(view, study, lit_);
    const IlluminanceOptions options = options_with(study.calculation, reflection, 0.0);
    Progress quiet;
    const Stopwatch watch;
    if (options.reflection != nullptr) {
      request.bounces = 0;
      SensorIlluminance one(1);
      options.reflection->all({{request.view.target}, {kZenith}}, one, quiet);
    }
    const ViewPlan plan = plan_view(request, lit_.engines(), lit_.source(), quiet);
    double sum = watch.seconds() + plan.reflection_s;
    for (const PlannedRegion& region : plan.regions) {
      sum += std::isfinite(region.predicted_s()) ? region.predicted_s() : 0.0;
    }
    return sum;
  }

  fs::path place(const std::string& name) {
    outcome_.files.push_back(folder_ / name);
    return outcome_.files.back();
  }

  Study study_;
  fs::path folder_;
  StageClock progress_;
  StudyMoment moment_;
  LitScene lit_;
  SceneReflection reflection_;
  ReportBuilder report_;
  StudyOutcome outcome_;
};

/// Refuses before the long work what would stop it later.
void check_study(const Study& study) {
  for (const StudySensors& sensors : study.sensors) read_sensor_file(sensors.file);
}

}  // namespace

StudyOutcome run_study(const Study& study, const fs::path& folder, Progress& progress,
                       std::optional<double> time_limit_s) {
  const Stopwatch watch;
  check_study(study);
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) {
    throw InputError("cannot make the folder " + folder.string() + ": " + error.message());
  }
  StudyRun run(study, folder, progress);  // reads the scene, places the sun, makes the sky
  const auto grids = run.place_sensors();
  const bool is_in_time = !time_limit_s || run.keep_within(*time_limit_s - watch.seconds(), grids);
  for (const StudyView& view : study.views) run.render(view);
  for (std::size_t i = 0; i < grids.size(); ++i) run.illuminate_surfaces(study.fields[i], grids[i]);
  for (const StudySensors& sensors : study.sensors) run.illuminate_sensors(sensors);
  if (study.plan) run.map_ground(*study.plan);
  StudyOutcome outcome = run.finish();
  outcome.is_in_time = is_in_time;
  return outcome;
}

}  // namespace tenku
