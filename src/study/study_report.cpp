#include "study/study_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/parallel.h"
#include "core/version.h"
#include "output/image_writer.h"
#include "reports/histogram.h"
#include "reports/sun_path_diagram.h"
#include "site/sun_path.h"
#include "study/view_output.h"
#include "view/value_scale.h"

namespace tenku {
namespace {

constexpr std::array<double, 5> kBands{1000.0, 5000.0, 10000.0, 25000.0, 50000.0};
constexpr std::array<const char*, 12> kMonths{"January",   "February", "March",    "April",
                                              "May",       "June",     "July",     "August",
                                              "September", "October",  "November", "December"};
constexpr std::array<const char*, 12> kShortMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                   "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};

/// Sums over the sensors of one kind of surface.
struct SurfaceSums {
  double area = 0.0, lux = 0.0, error = 0.0, lowest = 1e300, highest = 0.0;
  std::array<double, kBands.size() + 1> band{};
};

std::vector<DiagramPoint> diagram_points(const std::vector<SunPathPoint>& points) {
  std::vector<DiagramPoint> result;
  for (const SunPathPoint& p : points) result.push_back({p.azimuth, p.altitude});
  return result;
}

std::string lux_text(double lux) { return rounded_text(lux, 3); }

}  // namespace

ReportBuilder::ReportBuilder(const Study& study, const LitScene& lit, const StudyMoment& moment)
    : study_(study), lit_(lit), moment_(moment) {
  title_ = study.report ? study.report->title : "";
  if (title_.empty()) title_ = "Daylight in " + study.scene.file.stem().string();
  const Vec3 sun = lit.sky().sun.direction;
  content_.title = title_;
  content_.sky_in_words = lit.sky().description;
  content_.sun_azimuth = moment.sun ? moment.sun->azimuth : azimuth_of(sun);
  content_.sun_altitude = moment.sun ? moment.sun->apparent_altitude : altitude_of(sun);
  content_.band_limits.assign(kBands.begin(), kBands.end());
}

std::string ReportBuilder::time_text() const {
  return moment_.time ? iso_local(*moment_.time) : study_.time.at;
}

std::string ReportBuilder::place_in_words() const {
  if (!moment_.site) return "place not given";
  const double lat = moment_.site->latitude.in_degrees(),
               lon = moment_.site->longitude.in_degrees();
  return fmt::format("{:.4f}° {}, {:.4f}° {}", std::abs(lat), lat < 0 ? "S" : "N", std::abs(lon),
                     lon < 0 ? "W" : "E");
}

std::string ReportBuilder::time_in_words() const {
  if (!moment_.time) return "";
  const CivilTime& time = *moment_.time;
  const CalendarTime c = utc_calendar(later_by(time.instant, 60.0 * time.offset_minutes));
  const std::string clock = study_.time.zone == "solar" ? "mean solar time"
                            : time.zone.empty()
                                ? fmt::format("UTC{:+.2g} h", time.offset_minutes / 60.0)
                                : "time of " + time.zone;
  return fmt::format("{} {} {}, {:02}:{:02} {}", c.day,
                     kMonths[static_cast<std::size_t>(c.month - 1)], c.year, c.hour, c.minute,
                     clock);
}

void ReportBuilder::add_view(const RenderedView& view, const StudyView& request) {
  rays_ += view.rays;
  regions_.insert(regions_.end(), view.regions.begin(), view.regions.end());
  for (const Finding& finding : view.findings) add_note(finding);
  if (content_.view) return;  // the first one stands at the head of the report
  const Image8 picture = picture_of(view, request.show);
  content_.view =
      ReportPicture{png_bytes(picture), "View of the scene: " + request.name,
                    "The scene as lit at this hour. Brightness as a camera would see it."};
}

void ReportBuilder::add_light(const IlluminanceResult& result) {
  rays_ += result.rays;
  regions_.insert(regions_.end(), result.regions.begin(), result.regions.end());
  sensors_ += result.values.size();
  out_of_tolerance_ += result.out_of_tolerance;
  for (const Finding& finding : result.findings) add_note(finding);
}

void ReportBuilder::add_note(const Finding& finding) {
  const auto same = std::find_if(notes_.begin(), notes_.end(), [&](const Finding& known) {
    return known.code == finding.code && known.what == finding.what;
  });
  if (same == notes_.end()) {
    notes_.push_back(finding);
  } else {
    same->count += finding.count;
  }
}

std::string ReportBuilder::engines_in_words() const {
  std::set<std::string_view> names;
  for (const PlannedRegion& region : regions_) names.insert(name_of(region.engine));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::vector<ReportFact> ReportBuilder::regions_in_words() const {
  std::vector<ReportFact> facts;
  for (const PlannedRegion& r : regions_) {
    if (!r.is_shared) continue;
    std::string text = fmt::format("{} points by {} in {} directions", r.sensors, name_of(r.engine),
                                   r.elements + r.sun_directions);
    if (r.engine == Engine::ShadowMaps) {
      text +=
          fmt::format(", maps of {} x {} with texels of {:.2g} m", r.texels, r.texels, r.texel_m);
    }
    if (std::isfinite(r.reach_m)) {
      text += fmt::format("; casters farther than {:.0f} m could take {:.0f} lx", r.reach_m,
                          r.left_out_lux);
    }
    if (std::isfinite(r.predicted_s())) {
      text += fmt::format("; {:.2g} s expected, {:.2g} s taken", r.predicted_s(), r.measured_s);
    }
    facts.push_back({"direct light, region " + std::to_string(facts.size() + 1), text});
  }
  return facts;
}

void ReportBuilder::note(const std::string& what) {
  notes_.push_back({"study_note", Severity::Note, "", "", what, "", 1});
}

void ReportBuilder::add_field(const SensorGrid& grid, const SensorIlluminance& values) {
  std::map<SurfaceType, SurfaceSums> sums;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double area = grid.area_m2[i], lux = values.total_lux(i);
    if (is_dark(values, i)) {
      content_.hidden_area_m2 += area;
      continue;
    }
    SurfaceSums& s = sums[grid.type[i]];
    s.area += area;
    s.lux += area * lux;
    s.error += area * values.error_lux[i];
    s.lowest = std::min(s.lowest, lux);
    s.highest = std::max(s.highest, lux);
    const auto band = std::upper_bound(kBands.begin(), kBands.end(), lux) - kBands.begin();
    s.band[static_cast<std::size_t>(band)] += area;
  }
  for (const auto& [type, s] : sums) {
    ReportSurface surface{std::string(name_of(type)), s.area, s.lux / s.area, s.lowest, s.highest,
                          s.error / s.area,           {}};
    for (const double area : s.band) surface.band_shares.push_back(area / s.area);
    content_.surfaces.push_back(std::move(surface));
  }
}

PlanMap ReportBuilder::plan_of(const GroundPlan& ground, const SensorIlluminance& values,
                               const StudyPlan& request) {
  Ground g;
  g.lowest = 1e300;
  plan_values_.clear();
  double squares = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double lux = values.total_lux(i);
    plan_values_.push_back(lux);
    g.mean += lux;
    g.error += values.error_lux[i];
    squares += values.error_lux[i] * values.error_lux[i];
    g.lowest = std::min(g.lowest, lux);
    g.highest = std::max(g.highest, lux);
    g.sunlit_share += values.sun_lux[i] > 0.0;
  }
  const auto n = static_cast<double>(values.size());
  g.mean /= n, g.error /= n, g.sunlit_share /= n;
  ground_ = g;
  PlanMap map;
  map.title = "Illuminance on the ground";
  map.caption = fmt::format("{}; {}. Mean 95 % interval of a square ±{} lx.", time_text(),
                            lit_.sky().description, lux_text(g.error));
  map.grid = ground.grid;
  map.buildings = ground.buildings;
  if (request.lowest || request.highest) {
    const double low = request.lowest ? request.lowest->value() : 0.0;
    map.scale = scale_between(low, request.highest ? request.highest->value() : g.highest);
  }
  return map;
}

void ReportBuilder::add_plan(const Image8& map) {
  content_.plan =
      ReportPicture{png_bytes(map), "Plan of the illuminance on the ground",
                    "Illuminance on the ground, horizontal, seen from above; north is up."};
}

std::string ReportBuilder::sun_path() const {
  if (!moment_.site || !moment_.time || (study_.report && !study_.report->sun_path)) return "";
  const CalendarTime date = utc_calendar(moment_.time->instant);
  const SunPath path = tenku::sun_path(*moment_.site, date.year, moment_.time->offset_minutes);
  SunPathDiagram diagram;
  diagram.title = "Path of the sun at " + place_in_words();
  for (const auto& arc : path.day_arcs) {
    // December to June going up, the rest coming down: each pair of months shares its arc.
    const bool labelled = arc.number >= 6 && arc.number <= 12;
    const auto month = static_cast<std::size_t>(arc.number - 1);
    diagram.days.push_back(
        {labelled ? fmt::format("21 {}", kShortMonths[month]) : "", diagram_points(arc.points)});
  }
  for (const auto& line : path.hour_lines) {
    diagram.hours.push_back({std::to_string(line.number), diagram_points(line.points)});
  }
  diagram.instant = DiagramPoint{moment_.sun->azimuth, moment_.sun->apparent_altitude};
  diagram.instant_label = time_text().substr(11, 5);
  return sun_path_svg(diagram);
}

std::string ReportBuilder::sky_in_words() const {
  if (const auto& elements = lit_.source().elements) {
    return "Skylight is summed over the elements of a partition of the sky (" +
           elements->description() + "), each asked for in two directions.";
  }
  return "Skylight is summed over vertical slices of the sky; in each the skyline is found from "
         "the model itself.";
}

std::vector<ReportFigure> ReportBuilder::figures() const {
  std::vector<ReportFigure> figures;
  figures.push_back({"Open field", lux_text(lit_.source().unobstructed_lux()), "lx", "",
                     "What an unobstructed horizontal surface receives from sun and sky."});
  if (!ground_) return figures;
  figures.push_back({"Average on open ground", lux_text(ground_->mean), "lx",
                     fmt::format("± {} lx at a point (95 %)", lux_text(ground_->error)),
                     "Mean over all ground that no building covers, as in the plan."});
  figures.push_back({"Open ground in sunlight",
                     fmt::format("{:.0f}", 100.0 * ground_->sunlit_share), "%", "",
                     "Share of the open ground that the sun reaches at this moment."});
  figures.push_back({"Darkest and brightest",
                     lux_text(ground_->lowest) + " – " + lux_text(ground_->highest), "lx", "",
                     "The range over the open ground."});
  return figures;
}

std::string ReportBuilder::error_statement() const {
  const double tolerance = study_.calculation.tolerance_percent;
  const std::string asked = fmt::format(
      "The tolerance asked for is {} % of each value, or {} lx where that is more. ", tolerance,
      lux_text(0.01 * tolerance * IlluminanceOptions().floor_share *
               lit_.source().unobstructed_lux()));
  const std::string reached =
      out_of_tolerance_ == 0 ? fmt::format("The interval is within it at all {} points. ", sensors_)
                             : fmt::format("The interval is wider at {} of {} points ({:.2g} %). ",
                                           out_of_tolerance_, sensors_,
                                           100.0 * static_cast<double>(out_of_tolerance_) /
                                               static_cast<double>(sensors_));
  return "Every value carries a 95 % interval: the true value of the model as given lies inside it "
         "for 19 of 20 points. " +
         asked + (sensors_ > 0 ? reached : "") +
         "On surfaces and on the plan, neighbouring points share reflected light; what that costs "
         "is measured at some of them, which are calculated on their own, and is part of the "
         "interval, and so is an estimate of further reflections. Errors of the model itself, of "
         "its materials and of the sky are not included.";
}

std::vector<Finding> ReportBuilder::findings() const {
  std::vector<Finding> all = lit_.scene().findings;
  all.insert(all.end(), lit_.sky().diagnostics.begin(), lit_.sky().diagnostics.end());
  all.insert(all.end(), notes_.begin(), notes_.end());
  return all;
}

ReportContent ReportBuilder::content() const {
  ReportContent content = content_;
  content.place = place_in_words();
  content.time_in_words = time_in_words();
  content.figures = figures();
  if (ground_) {
    content.summary = fmt::format(
        "At this moment the open ground receives {} lux on average, {:.0f} % of what an open field "
        "would receive; the sun reaches {:.0f} % of it.",
        lux_text(ground_->mean), 100.0 * ground_->mean / lit_.source().unobstructed_lux(),
        100.0 * ground_->sunlit_share);
    content.histogram_svg = histogram_svg({.title = "Illuminance on the ground",
                                           .quantity = "Illuminance on the ground",
                                           .unit = "lx",
                                           .values = plan_values_,
                                           .weights = {}});
  }
  content.sun_path_svg = sun_path();
  content.findings = findings();
  content.method = {"Sunlight comes from the solar disc, so that shadows have soft edges. " +
                    sky_in_words() + " Reflected light follows paths of up to " +
                    std::to_string(study_.calculation.bounces) + " diffuse reflections."};
  content.error_statement = error_statement();
  const TriangleSoup& soup = lit_.soup();
  content.settings = {{"scene", study_.scene.file.filename().string()},
                      {"triangles", std::to_string(soup.size())},
                      {"sky", study_.sky.model},
                      {"tolerance", fmt::format("{} %", study_.calculation.tolerance_percent)},
                      {"bounces", std::to_string(study_.calculation.bounces)},
                      {"seed", std::to_string(study_.calculation.seed)},
                      {"engine", engines_in_words()},
                      {"rays", std::to_string(rays_)}};
  const std::vector<ReportFact> regions = regions_in_words();
  content.settings.insert(content.settings.end(), regions.begin(), regions.end());
  content.versions = {{"software", std::string(software_name())}};
  return content;
}

Manifest ReportBuilder::manifest(const std::vector<std::filesystem::path>& files,
                                 const std::vector<ManifestStage>& stages) const {
  Manifest manifest;
  manifest.stages = stages;
  manifest.command = "tenku run " + study_.file.string();
  manifest.inputs.push_back(manifest_input(study_.file));
  manifest.inputs.push_back(manifest_input(study_.scene.file));
  for (const auto& file : study_.scene.terrain) manifest.inputs.push_back(manifest_input(file));
  if (study_.scene.materials) manifest.inputs.push_back(manifest_input(*study_.scene.materials));
  for (const StudySensors& s : study_.sensors) manifest.inputs.push_back(manifest_input(s.file));
  const auto seed = static_cast<std::int64_t>(study_.calculation.seed);
  const auto& elements = lit_.source().elements;
  manifest.settings = {{"time", time_text()},
                       {"sky", study_.sky.model},
                       {"tolerance_pct", study_.calculation.tolerance_percent},
                       {"bounces", std::int64_t{study_.calculation.bounces}},
                       {"engine", engines_in_words()},
                       {"partition", elements ? elements->description() : "slices"},
                       {"seed", seed},
                       {"ground", study_.scene.ground},
                       {"crs", study_.scene.crs},
                       {"sun_azimuth_deg", content_.sun_azimuth.in_degrees()},
                       {"sun_altitude_deg", content_.sun_altitude.in_degrees()}};
  manifest.versions = output_library_versions();
  manifest.results = {{"sensors", static_cast<std::int64_t>(sensors_)},
                      {"rays", static_cast<std::int64_t>(rays_)},
                      {"depth_maps", static_cast<std::int64_t>(lit_.engines().maps_drawn())},
                      {"elements", static_cast<std::int64_t>(lit_.source().element_count())},
                      {"out_of_tolerance", static_cast<std::int64_t>(out_of_tolerance_)},
                      {"horizontal_lux", lit_.source().unobstructed_lux()},
                      {"sky_description", lit_.sky().description}};
  for (const auto& file : files) manifest.files.push_back(file.filename().string());
  manifest.diagnostics = findings();
  manifest.machine = this_machine();
  manifest.threads = thread_count();
  manifest.seed = study_.calculation.seed;
  return manifest;
}

}  // namespace tenku
