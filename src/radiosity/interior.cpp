#include "radiosity/interior.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/stopwatch.h"
#include "illuminance/error_budget.h"
#include "radiosity/settled_looks.h"

namespace tenku {
namespace {

constexpr double kShotShare = 0.1;   // of the tolerance: what shots may leave unshot
constexpr double kSweepShare = 0.1;  // of the tolerance, in dim places: left by sweeps
constexpr double kAgain = 1.05;      // times the tolerance: corners that one light has made exact
constexpr double kDimShare = 0.1;    // of the mean light: dimmer corners need not be exact
constexpr double kUsualTolerance = 2.0, kFinestTolerance = 0.5;  // percent
constexpr int kFinestCorner = 128;
constexpr double kRounding = 1e-5;   // of the sum of a row
constexpr int kLampRays = 4096;      // to a lamp that a sensor sees in part
constexpr int kCornerLampRays = 64;  // to one that a corner does, at the usual tolerance

PointGatherOptions gather_options(const InteriorOptions& options, int resolution) {
  PointGatherOptions gather;
  gather.method = options.form_factors;
  gather.form_factors = options.shot;
  gather.form_factors.resolution = resolution;
  gather.lift_m = options.lift_m;
  gather.most_bytes = options.most_bytes / 2;
  return gather;
}

/// Finer than this a mesh is not asked to be: its own error is greater.
double mesh_tolerance_pct(const InteriorOptions& options) {
  return std::max(options.tolerance_pct, kFinestTolerance);
}

/// The error of n strata falls as n^(-3/4), and n as the square of the resolution.
int corner_resolution(const InteriorOptions& options) {
  if (options.point_resolution > 0) return options.point_resolution;
  const double finer = std::pow(kUsualTolerance / mesh_tolerance_pct(options), 2.0 / 3.0);
  return static_cast<int>(std::lround(std::clamp(24.0 * finer, 16.0, 128.0)));
}

/// Of a lamp seen in part n rays miss n^(-3/4).
int corner_lamp_rays(const InteriorOptions& options) {
  const double finer = std::pow(kUsualTolerance / mesh_tolerance_pct(options), 4.0 / 3.0);
  return std::max(kCornerLampRays, static_cast<int>(std::lround(kCornerLampRays * finer)));
}

PointGatherOptions corner_options(const InteriorOptions& options) {
  PointGatherOptions corners = gather_options(options, corner_resolution(options));
  corners.finest = kFinestCorner;
  return corners;
}

SurfaceLight scaled(SurfaceLight surfaces, double lamp_scale) {
  for (Rgb& emission : surfaces.emission_lm_m2) emission = lamp_scale * emission;
  return surfaces;
}

/// What sides send before any reflection between them, lm/m2.
std::vector<double> first_sent(const SurfaceLight& surfaces, const DaylightOnSides& direct) {
  std::vector<double> sent;
  for (std::size_t s = 0; s < direct.lux.size(); ++s) {
    sent.push_back(
        luminance_of(surfaces.emission_lm_m2[s / 2] + direct.lux[s] * surfaces.reflectance[s / 2]));
  }
  return sent;
}

/// What may still reach a point: nothing where surfaces in sight send nothing.
double light_under_way(const CornerLight& corners, double received_lux) {
  return received_lux > 0.0 ? corners.convergence_lux : 0.0;
}

/// Adds to a sensor what it receives from sides.
void add_from_sides(const InteriorLight& light, Rgb lux, double half_width_lux, std::size_t i,
                    SensorIlluminance& values) {
  values.set_reflected(i, values.reflected_rgb[i] + lux);
  values.error_lux[i] = std::hypot(values.error_lux[i], half_width_lux) +
                        light_under_way(light.corners, luminance_of(lux));
}

bool is_any(Rgb c) { return c.r > 0.0 || c.g > 0.0 || c.b > 0.0; }

/// Whole planes on which anything is so: values are wanted up to their edges.
std::vector<std::uint8_t> on_whole_planes(const SidePoints& points,
                                          std::vector<std::uint8_t> is_so) {
  std::vector<std::uint8_t> of_plane(points.planes);
  for (std::size_t i = 0; i < is_so.size(); ++i) of_plane[points.plane[i]] |= is_so[i];
  for (std::size_t i = 0; i < is_so.size(); ++i) is_so[i] = of_plane[points.plane[i]];
  return is_so;
}

}  // namespace

Interior::Interior(const ElementMesh& mesh, const std::vector<Material>& materials,
                   const InteriorOptions& options)
    : mesh_(mesh),
      options_(options),
      surfaces_(surface_light(mesh, materials, findings_)),
      points_(side_points(mesh)),
      method_(form_factor_method(options.form_factors, mesh, options.shot)),
      rows_(mesh, *method_, {.lift_m = options.lift_m, .most_bytes = options.most_bytes / 2}),
      gather_(mesh, points_.sensors, corner_options(options)),
      emitters_(mesh, points_, surfaces_, options.shot.seed),
      daylight_(options.many_skies) {
  if (!(options.tolerance_pct > 0.0 && options.tolerance_pct <= 100.0)) {
    throw InputError("tolerance " + std::to_string(options.tolerance_pct) +
                     " is not in (0, 100] percent");
  }
}

const std::vector<std::uint8_t>& Interior::open_points(Progress& progress) {
  if (is_open_) return *is_open_;
  const Stopwatch watch;
  const std::vector<std::uint8_t> all(points_.size(), 1);
  gather_.prepare(all, progress);
  std::vector<std::uint8_t> is_open(points_.size());
  enclosure_.resize(points_.size());
  gather_.for_rows(all, [&](std::size_t point, std::size_t, const FormFactorRow& row) {
    double sum = 0.0;
    for (const FormFactor& f : row) sum += f.value;
    if (sum < 1.0 - kRounding) is_open[point] = 1;
    enclosure_[point] += static_cast<float>(sum / PointGather::kLooks);
  });
  times_.form_factors_s += watch.seconds();
  is_open_ = on_whole_planes(points_, std::move(is_open));
  return *is_open_;
}

/// Areas of sides, as far as light from them meets others.
std::vector<double> Interior::enclosed_areas() const {
  std::vector<double> area;
  for (std::size_t s = 0; s < mesh_.sides(); ++s) {
    area.push_back(surfaces_.area_m2[s / 2]);
    if (!enclosure_.empty()) area.back() *= enclosure_[points_.corner[s][0]];
  }
  return area;
}

RefinementResult Interior::shoot(const SurfaceLight& surfaces, const DaylightOnSides& direct,
                                 SentLight start, Progress& progress) {
  std::vector<Rgb> on_sides;
  for (const double lux : direct.lux) on_sides.push_back(Rgb::grey(lux));
  RefinementOptions refinement;
  refinement.start = std::move(start);
  refinement.tolerance = kShotShare * mesh_tolerance_pct(options_) / 100.0;
  refinement.most_shots = options_.most_shots;
  refinement.watch = options_.watch;
  const Stopwatch watch;
  const double before = rows_.seconds();
  RefinementResult result =
      refine_progressively(mesh_, surfaces, on_sides, rows_, refinement, progress);
  const double looking = rows_.seconds() - before;
  times_.form_factors_s += looking;
  times_.solve_s += watch.seconds() - looking;
  return result;
}

std::vector<std::uint8_t> Interior::lit_points(const SideRadiosity& sides,
                                               const DaylightOnSides& direct) const {
  std::vector<std::uint8_t> is_lit(points_.size());
  for (std::size_t s = 0; s < mesh_.sides(); ++s) {
    if (!is_any(sides.received[s]) && !(direct.lux[s] > 0.0) && !is_any(sides.radiosity[s])) {
      continue;
    }
    for (const std::uint32_t i : points_.corner[s]) is_lit[i] = 1;
  }
  return on_whole_planes(points_, std::move(is_lit));
}

const LampsOnMesh& Interior::lamps_on(std::span<const std::uint8_t> is_lit) {
  bool is_known = lamps_known_.size() == is_lit.size();
  for (std::size_t i = 0; i < is_lit.size() && is_known; ++i) {
    is_known = is_lit[i] == 0 || lamps_known_[i] != 0;
  }
  if (!is_known) {
    lamps_known_.assign(is_lit.begin(), is_lit.end());
    lamps_ = lamps_on_mesh(mesh_, surfaces_, points_, emitters_, gather_, is_lit, options_.lift_m,
                           corner_lamp_rays(options_));
  }
  return lamps_;
}

InteriorLight Interior::light(const LightRequest& request, Progress& progress) {
  InteriorLight light;
  light.findings = findings_;
  light.lamp_scale = request.lamp_scale;
  DaylightOnSides direct(points_.size(), mesh_.sides());
  if (request.daylight != nullptr) {
    const auto& is_open = open_points(progress);
    const Stopwatch watch;
    DaylightMethod daylight = *request.daylight;
    daylight.options.tolerance_pct =
        std::max(daylight.options.tolerance_pct, mesh_tolerance_pct(options_));
    direct = daylight_on_sides(mesh_, points_, is_open, daylight, daylight_, progress);
    times_.daylight_s += watch.seconds();
    light.findings.insert(light.findings.end(), direct.findings.begin(), direct.findings.end());
  }
  const SurfaceLight surfaces = scaled(surfaces_, request.lamp_scale);
  const std::vector<double> weight = enclosed_areas();
  std::vector<double> source = first_sent(surfaces, direct);
  LightStart former = former_.start(source, weight);
  light.shots = shoot(surfaces, direct, std::move(former.sent), progress);
  light.is_lit = lit_points(light.shots.sides, direct);
  light.points = direct.points;
  const Stopwatch looking;
  gather_.prepare(light.is_lit, progress);
  times_.form_factors_s += looking.seconds();
  const Stopwatch sweeping;
  const CornerProblem problem{mesh_,
                              surfaces,
                              points_,
                              lamps_on(light.is_lit),
                              request.lamp_scale,
                              direct,
                              kSweepShare * mesh_tolerance_pct(options_)};
  CornerLight start;
  start.radiosity = light.shots.sides.radiosity;
  for (std::size_t s = 0; s < former.beyond_shots.size(); ++s) {
    start.radiosity[s] = start.radiosity[s] + former.beyond_shots[s];
    if (light.is_lit[points_.corner[s][0]] == 0) start.radiosity[s] = {};
  }
  light.corners = std::move(start);
  const double margin = has_light_ ? kAgain : 1.0;
  for (;;) {
    light.corners =
        solve_at_corners(problem, gather_, std::move(light.corners), light.is_lit, progress);
    std::vector<std::uint8_t> rough = rough_points(light, margin);
    if (!gather_.look_finer(rough)) break;
    const Stopwatch again;
    gather_.prepare(rough, progress);
    times_.form_factors_s += again.seconds();
    times_.solve_s -= again.seconds();
  }
  has_light_ = true;
  light.corners.mesh_lux = mesh_errors_lux(light.corners, gather_, light.is_lit);
  if (options_.many_skies && light.shots.is_converged) {
    former_.keep(std::move(source), weight, light.shots, light.corners.radiosity);
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    light.points.set_reflected(i, light.corners.lux[i]);
    light.points.error_lux[i] =
        std::hypot(light.points.error_lux[i],
                   interval_lux(light.corners.variance[i], light.corners.mesh_lux[i])) +
        light_under_way(light.corners, luminance_of(light.corners.lux[i]));
  }
  times_.solve_s += sweeping.seconds();
  tell_refused(light.findings);
  tell_leaks(light);
  return light;
}

std::vector<std::uint8_t> Interior::rough_points(const InteriorLight& light, double margin) const {
  const CornerLight& corners = light.corners;
  const auto lux = [&](std::size_t i) {
    return light.points.sun_lux[i] + light.points.sky_lux[i] + luminance_of(corners.lux[i]);
  };
  double sum = 0.0, lit = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    sum += lux(i);
    lit += luminance_of(corners.lux[i]) > 0.0;
  }
  const ErrorBudget budget(mesh_tolerance_pct(options_), kDimShare * sum / std::max(lit, 1.0));
  std::vector<std::uint8_t> rough(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    rough[i] =
        steps_finer(interval_lux(corners.variance[i], 0.0), margin * budget.allowed_lux(lux(i)));
  }
  return rough;
}

void Interior::tell_leaks(InteriorLight& light) {
  if (!(light.shots.balance.escaped_lm > 0.0)) return;
  if (!leaks_) {
    std::vector<double> lux;
    for (std::size_t i = 0; i < points_.size(); ++i) lux.push_back(light.points.total_lux(i));
    leaks_ = find_light_leaks(mesh_, points_.sensors, lux, options_.lift_m, options_.shot.seed);
  }
  tell_light_leaks(*leaks_, light.findings);
}

void Interior::tell_refused(std::vector<Finding>& findings) const {
  const std::size_t refused = rows_.refused() + gather_.refused();
  if (refused == 0) return;
  Finding finding;
  finding.code = "form_factors_not_kept";
  finding.severity = Severity::Note;
  finding.what = "the memory given does not hold all form factors: " + std::to_string(refused) +
                 " rows are found anew whenever they are needed";
  finding.repair = "more --memory, larger elements, or a lower --resolution";
  finding.count = refused;
  findings.push_back(std::move(finding));
}

InteriorSensors Interior::look_from(const Sensors& sensors) const {
  InteriorSensors look;
  look.all.assign(sensors.size(), 1);
  look.gather = std::make_unique<PointGather>(mesh_, sensors,
                                              gather_options(options_, options_.sensor_resolution));
  look.lamps = light_of_lamps(emitters_, sensors, look.all, options_.lift_m, kLampRays);
  return look;
}

void Interior::add_lamps(const Sensors& points, const InteriorLight& light, bool on_edges,
                         SensorIlluminance& values, Progress& progress) const {
  if (!emitters_.is_any()) return;
  progress.begin("light of lamps", 0);
  const auto lamps = emitters_.at_pixels(
      points, options_.lift_m,
      on_edges ? EmitterLight::PixelLook::OnEdges : EmitterLight::PixelLook::Usual);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Rgb lux = light.lamp_scale * lamps[i].lux;
    values.set_reflected(i, values.reflected_rgb[i] + lux);
    const double interval = interval_lux(lamps[i].variance, 0.0);
    values.error_lux[i] = std::hypot(values.error_lux[i], light.lamp_scale * interval);
  }
  progress.end(std::to_string(points.size()) + " places in the picture");
}

void Interior::add_reflected(InteriorSensors& sensors, const InteriorLight& light,
                             SensorIlluminance& values, Progress& progress) const {
  const SurfaceLight lit = scaled(surfaces_, light.lamp_scale);
  const std::vector<Rgb> sent = reflected_part(lit, light.corners.radiosity);
  const std::vector<MeshDoubt> doubts = mesh_doubts(light.corners);
  const auto look = [&](std::span<const std::uint8_t> rough, LooksOfSensors& found) {
    sensors.gather->prepare(rough, progress);
    sensors.gather->for_rows(rough, [&](std::size_t i, std::size_t l, const FormFactorRow& row) {
      Rgb sum = light.lamp_scale * sensors.lamps[i].lux;
      if (lit.any_emits) {
        sum = sum + emission_left_to_row(lit, emitters_, sensors.lamps[i], row);
      }
      for (const FormFactor& f : row) sum = sum + f.value * sent[f.side];
      found.lux[i][l] = sum;
      found.mesh_lux[i][l] = mesh_error_lux(row, doubts);
    });
  };
  const SettledLooks settled = settle_looks(
      sensors.gather->points(), values, options_.tolerance_pct, look,
      [&](std::span<std::uint8_t> steps) { return sensors.gather->look_finer(steps); });
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double of_lamps = light.lamp_scale * light.lamp_scale * sensors.lamps[i].variance;
    const double interval = interval_lux(settled.variance[i] + of_lamps, settled.mesh_lux[i]);
    add_from_sides(light, settled.lux[i], interval, i, values);
  }
}

void Interior::add_reflected_to_pixels(const Sensors& points, int mean_of,
                                       const InteriorLight& light, SensorIlluminance& values,
                                       Progress& progress) {
  if (!pixels_) {
    pixels_ = std::make_unique<PixelGather>(
        mesh_, gather_options(options_, options_.sensor_resolution / 2));
  }
  const SurfaceLight lit = scaled(surfaces_, light.lamp_scale);
  const std::vector<Rgb> sent = reflected_part(lit, light.corners.radiosity);
  const RadiositySlopes slopes(mesh_, points_, lit, light.points, sent, light.corners.open);
  const std::vector<MeshDoubt> doubts = mesh_doubts(light.corners);
  const SettledLooks settled =
      pixels_->gather(points, {lit, emitters_, light.lamp_scale, sent, slopes, doubts}, values,
                      {options_.tolerance_pct, mean_of}, progress);
  for (std::size_t i = 0; i < values.size(); ++i) {
    add_from_sides(light, settled.lux[i], interval_lux(settled.variance[i], settled.mesh_lux[i]), i,
                   values);
  }
}

}  // namespace tenku
