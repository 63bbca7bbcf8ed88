#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/lit_scene_options.h"
#include "cli/option_list.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/stopwatch.h"
#include "study/reflected_sun.h"
#include "study/reflection_files.h"
#include "study/reflection_report.h"
#include "study/sun_views.h"

namespace tenku {
namespace {

struct ReflectionsCommandOptions {
  SceneOptions scene;
  SiteOptions site;
  SkyOptions sky{.model = "cie:12", .sky_illuminance_lx = {}, .sun_illuminance_lx = {}};
  bool day = false, year = false;
  double step_min = 5.0, plan_cell_m = 1.0, path_step_m = 1.0;
  int depth = 2;
  double least_lux = 1.0;
  std::string overlaps = "add";
  std::vector<std::string> out;
  std::string panels, windows, report, observers, path, views;
};

bool has_sun_angles(const ReflectionsCommandOptions& o) {
  return o.site.sun_altitude_deg || o.site.sun_azimuth_deg;
}

bool has_observers(const ReflectionsCommandOptions& o) {
  return !o.observers.empty() || !o.path.empty();
}

void check_times(const ReflectionsCommandOptions& o) {
  if (o.day && o.year) throw InputError("give --day or --year, not both");
  if (!has_sun_angles(o) && o.site.time.empty()) {
    throw InputError("give --time, or --sun-altitude and --sun-azimuth");
  }
  if ((o.day || o.year) && has_sun_angles(o)) {
    throw InputError("--day and --year need --time; --sun-altitude gives one sun alone");
  }
  if (has_observers(o) && has_sun_angles(o)) {
    throw InputError("observers are told times: give --time, not --sun-altitude");
  }
  if (!(o.step_min >= 0.1 && o.step_min <= 720.0)) {
    throw InputError(fmt::format("--step {} minutes is not in 0.1..720", o.step_min));
  }
}

void check_outputs(const ReflectionsCommandOptions& o) {
  if (o.out.empty() && o.report.empty() && o.panels.empty() && o.windows.empty() &&
      o.views.empty()) {
    throw InputError("give --out FILE.csv, .geojson or .vtp, or --report FILE.html");
  }
  for (const std::string& out : o.out) {
    if (!is_reflection_output(out)) {
      throw InputError("cannot write '" + out + "': the ending must be .csv, .geojson or .vtp");
    }
    check_can_write(out);
  }
  for (const std::string& file : {o.panels, o.windows, o.report, o.views}) {
    if (!file.empty()) check_can_write(file);
  }
  if (o.views.empty() && o.report.empty() && has_observers(o)) {
    throw InputError("--observers and --path need --views FILE.csv or --report FILE.html");
  }
  if (!o.views.empty() && !has_observers(o)) {
    throw InputError("--views needs --observers FILE.csv or --path FILE.csv");
  }
}

void check_request(const ReflectionsCommandOptions& o) {
  check_times(o);
  if (o.depth < 1 || o.depth > 16) {
    throw InputError(fmt::format("--depth {} is not in 1..16 mirrors", o.depth));
  }
  if (!(o.least_lux >= 0.0 && o.least_lux <= 1e6)) {
    throw InputError(fmt::format("--least-lux {} is not in 0..1e6", o.least_lux));
  }
  if (!(o.plan_cell_m > 0.0 && o.plan_cell_m <= 1000.0)) {
    throw InputError(fmt::format("--plan-cell {} metres is not in 0..1000", o.plan_cell_m));
  }
  if (o.overlaps != "add" && o.overlaps != "keep") {
    throw InputError("--overlaps is 'add' or 'keep', not '" + o.overlaps + "'");
  }
  if (o.overlaps == "keep" && !o.report.empty()) {
    throw InputError("--report adds overlaps up: leave out --overlaps keep");
  }
  check_outputs(o);
}

class ReflectionsRun {
 public:
  ReflectionsRun(const ReflectionsCommandOptions& options, const CommandContext& context)
      : options_(options),
        context_(context),
        lit_(
            options.scene.scene, read(),
            [&](const std::optional<Location>& at) {
              return resolve_sky(options.site, options.sky, at);
            },
            std::nullopt, GlPlatform::Auto, context.progress) {}

  int finish() {
    how_.how.depth = static_cast<unsigned>(options_.depth);
    how_.how.least_lux = options_.least_lux;
    how_.adds_overlaps = options_.overlaps == "add";
    read_observers_of_options();
    sun_ = reflected_sun(lit_, moments(), how_, context_.progress);
    if (!observers_.empty()) {
      views_ = sun_views(
          sun_, lit_, observers_,
          [&](const CivilTime& time) { return *resolve_sun(site_at(time), lit_.site()); },
          context_.progress);
    }
    findings_ = findings_of(sun_, how_);
    write();
    std::vector<Finding> all = lit_.scene().findings;
    all.insert(all.end(), findings_.begin(), findings_.end());
    say_findings(context_.options, all);
    if (context_.options.json) fmt::print("{}\n", summary().dump(2));
    return kDone;
  }

 private:
  ReadOptions read() const {
    ReadOptions read = read_options(options_.scene);
    if (options_.site.latitude_deg) read.site = resolve_location(options_.site, std::nullopt);
    return read;
  }

  SiteOptions site_at(const CivilTime& time) const {
    SiteOptions site = options_.site;
    site.time = iso_local(time);
    return site;
  }

  void read_observers_of_options() {
    const FileFrame& frame = lit_.scene().frame;
    if (!options_.observers.empty()) observers_ = read_observers(options_.observers, frame);
    if (!options_.path.empty()) {
      const auto more = read_path(options_.path, frame, options_.path_step_m);
      observers_.insert(observers_.end(), more.begin(), more.end());
    }
  }

  std::vector<SunMoment> moments() {
    const auto time = resolve_time(options_.site);
    if (!(options_.day || options_.year)) {
      SunMoment moment{time, lit_.sky().sun, 0.0, 0};
      refuse_sunless(lit_.sky());
      return moment.is_up() ? std::vector{moment} : std::vector<SunMoment>{};
    }
    std::vector<CivilTime> days{*time};
    if (options_.year) {
      days.clear();
      for (const NamedDay& day : turning_days(*time, *resolve_location(options_.site, lit_.site())))
        days.push_back(day.noon);
    }
    std::vector<SunMoment> all;
    const auto sky_at = [&](const CivilTime& at) {
      Sky sky = resolve_sky(site_at(at), options_.sky, lit_.site());
      refuse_sunless(sky);
      return sky;
    };
    for (std::size_t d = 0; d < days.size(); ++d) {
      const auto some = moments_of(instants_of_day(days[d], options_.step_min), options_.step_min,
                                   static_cast<int>(d), sky_at);
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }

  /// A sky of clouds has no sun to throw; weather and irradiance may have none at an instant.
  void refuse_sunless(const Sky& sky) const {
    const std::string& model = options_.sky.model;
    const bool may_lack = model.starts_with("weather:") || model.starts_with("perez:");
    if (may_lack || !(sky.sun.direction.z > 0.0) || sky.sun.normal_illuminance.value() > 0.0) {
      return;
    }
    throw InputError("the sky '" + model +
                     "' has no sun to be reflected: give --sky cie:12, or --sun-illuminance");
  }

  std::string when() const {
    if (has_sun_angles(options_)) return "a sun given by its angles";
    const std::string at = iso_local(*resolve_time(options_.site));
    if (options_.year) {
      return fmt::format("equinoxes and solstices of {}, every {:.3g} minutes", at.substr(0, 4),
                         options_.step_min);
    }
    if (options_.day) {
      return fmt::format("{}, every {:.3g} minutes", at.substr(0, 10), options_.step_min);
    }
    return at;
  }

  void write() const {
    for (const std::string& out : options_.out) write_reflections(out, sun_, lit_);
    if (!options_.panels.empty()) panel_table(sun_, lit_).write(options_.panels);
    if (!options_.windows.empty()) window_table(sun_, lit_).write(options_.windows);
    if (!options_.views.empty()) view_table(views_, sun_, observers_).write(options_.views);
    if (options_.report.empty()) return;
    ReflectionReport request;
    request.title =
        "Reflected sunlight: " + std::filesystem::path(options_.scene.scene).filename().string();
    request.when = when();
    request.plan_cell_m = options_.plan_cell_m;
    if (!observers_.empty()) {
      request.observers = &observers_;
      request.views = &views_;
    }
    request.findings = findings_;
    write_whole_file(options_.report, reflection_report(request, sun_, lit_));
  }

  nlohmann::ordered_json summary() const {
    std::size_t throwing = 0;
    for (const PanelSum& sum : sun_.sums) throwing += sum.instants > 0 ? 1 : 0;
    return {{"seconds", watch_.seconds()},
            {"panels", sun_.panels.size()},
            {"panels_that_throw", throwing},
            {"instants", sun_.moments.size()},
            {"polygons", sun_.polygon_count()},
            {"most_lux", sun_.most_lux},
            {"started_lm", sun_.started_lm},
            {"landed_lm", sun_.landed_lm},
            {"sky_lm", sun_.sky_lm},
            {"unfollowed_lm", sun_.unfollowed_lm},
            {"balance_error", sun_.balance_error()},
            {"observers", observers_.size()},
            {"views", views_.size()}};
  }

  const ReflectionsCommandOptions& options_;
  const CommandContext& context_;
  Stopwatch watch_;
  LitScene lit_;
  ReflectionOptions how_;
  std::vector<SunObserver> observers_;
  ReflectedSun sun_;
  std::vector<SunView> views_;
  std::vector<Finding> findings_;
};

void add_options(OptionList& app, ReflectionsCommandOptions& o) {
  add_scene_options(app, o.scene);
  add_site_options(app, o.site);
  add_sky_options(app, o.sky);
  app.get_option("--sky").description(
      "cie:1 .. cie:15 (default cie:12, clear), perez:DNI,DHI (W/m2), weather:FILE.epw or "
      "FILE.wea: the sun "
      "is the sky's");
  app.add_flag("--day", o.day, "the whole day of --time, on its clock");
  app.add_flag("--year", o.year, "both equinoxes and both solstices of its year");
  app.add_option("--step", o.step_min, "from one instant to the next, minutes (default 5)");
  app.add_option("--depth", o.depth, "mirrors that light is followed through (default 2)");
  app.add_option("--least-lux", o.least_lux,
                 "weaker beams are not followed, lx across them (default 1)");
  app.add_option("--overlaps", o.overlaps,
                 "add: polygons that do not overlap, with the lux of all (default); keep: those of "
                 "each panel");
  app.add_option("--out", o.out,
                 "polygons that get reflected sun: .csv, .geojson or .vtp; - for a table on "
                 "standard output. May be given more than once");
  app.add_option("--panels", o.panels, "table by panel to write");
  app.add_option("--windows", o.windows, "table of the times of panels and objects to write");
  app.add_option("--report", o.report, "page to write, .html");
  app.add_option("--plan-cell", o.plan_cell_m, "squares of its plan, metres (default 1)");
  app.add_option("--observers", o.observers,
                 "eyes or windows: table name,x,y,z[,nx,ny,nz] in the file's coordinates");
  app.add_option("--path", o.path, "path of an eye: table x,y,z of its corners");
  app.add_option("--path-step", o.path_step_m, "between observers on it, metres (default 1)");
  app.add_option("--views", o.views, "table of when observers see the reflected sun to write");
}

}  // namespace

CommandBody make_reflections_command(OptionList& app) {
  const auto options = std::make_shared<ReflectionsCommandOptions>();  // outlives this call
  add_options(app, *options);
  return [options](const CommandContext& context) {
    check_request(*options);
    return ReflectionsRun(*options, context).finish();
  };
}

}  // namespace tenku
