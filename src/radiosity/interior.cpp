#include "radiosity/interior.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/stopwatch.h"
#include "illuminance/error_budget.h"

namespace tenku {
namespace {

constexpr double kShotShare = 0.1;   // of the tolerance: what shots may leave unshot
constexpr double kSweepShare = 0.1;  // of the tolerance and the mean light: left by sweeps
constexpr int kLampRays = 4096;      // to a lamp that a sensor sees in part

PointGatherOptions gather_options(const InteriorOptions& options, int resolution) {
  PointGatherOptions gather;
  gather.method = options.form_factors;
  gather.form_factors = options.shot;
  gather.form_factors.resolution = resolution;
  gather.lift_m = options.lift_m;
  gather.most_bytes = options.most_bytes / 2;
  return gather;
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
      gather_(mesh, points_.sensors, gather_options(options, options.point_resolution)),
      emitters_(mesh, points_, surfaces_, options.shot.seed) {}

std::vector<std::uint8_t> Interior::open_points(Progress& progress) {
  const Stopwatch watch;
  const std::vector<std::uint8_t> all(points_.size(), 1);
  gather_.prepare(all, progress);
  std::vector<std::uint8_t> is_open(points_.size());
  gather_.for_rows(all, [&](std::size_t point, std::size_t, const FormFactorRow& row) {
    double sum = 0.0;
    for (const FormFactor& f : row) sum += f.value;
    if (sum < 1.0 - 1e-5) is_open[point] = 1;
  });
  times_.form_factors_s += watch.seconds();
  return on_whole_planes(points_, std::move(is_open));
}

InteriorLight Interior::light(const DaylightMethod* daylight, Progress& progress) {
  InteriorLight light;
  light.findings = findings_;
  DaylightOnSides direct(points_.size(), mesh_.sides());
  if (daylight != nullptr) {
    const auto is_open = open_points(progress);
    const Stopwatch watch;
    direct = daylight_on_sides(mesh_, points_, is_open, *daylight, progress);
    times_.daylight_s += watch.seconds();
    light.findings.insert(light.findings.end(), direct.findings.begin(), direct.findings.end());
  }
  std::vector<Rgb> on_sides;
  for (const double lux : direct.lux) on_sides.push_back(Rgb::grey(lux));
  RefinementOptions refinement;
  refinement.tolerance = kShotShare * options_.tolerance_pct / 100.0;
  refinement.most_shots = options_.most_shots;
  refinement.watch = options_.watch;
  const Stopwatch solving;
  const double before = rows_.seconds();
  light.shots = refine_progressively(mesh_, surfaces_, on_sides, rows_, refinement, progress);
  times_.form_factors_s += rows_.seconds() - before;
  times_.solve_s += solving.seconds() - (rows_.seconds() - before);

  std::vector<std::uint8_t> is_lit(points_.size());
  for (std::size_t s = 0; s < mesh_.sides(); ++s) {
    const SideRadiosity& sides = light.shots.sides;
    if (!is_any(sides.received[s]) && !(direct.lux[s] > 0.0) && !surfaces_.emits(s / 2)) continue;
    for (const std::uint32_t i : points_.corner[s]) is_lit[i] = 1;
  }
  light.is_lit = on_whole_planes(points_, std::move(is_lit));
  light.points = direct.points;
  const Stopwatch looking;
  gather_.prepare(light.is_lit, progress);
  times_.form_factors_s += looking.seconds();
  const Stopwatch sweeping;
  const CornerProblem problem{mesh_,
                              surfaces_,
                              points_,
                              emitters_,
                              direct,
                              options_.lift_m,
                              kSweepShare * options_.tolerance_pct};
  light.corners =
      solve_at_corners(problem, gather_, light.shots.sides.radiosity, light.is_lit, progress);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    light.points.reflected_lux[i] = luminance_of(light.corners.lux[i]);
    light.points.error_lux[i] =
        std::hypot(light.points.error_lux[i],
                   interval_lux(light.corners.variance[i], light.corners.mesh_lux[i])) +
        light.corners.convergence_lux;
  }
  times_.solve_s += sweeping.seconds();
  return light;
}

void Interior::add_reflected(const Sensors& sensors, const InteriorLight& light,
                             SensorIlluminance& values, Progress& progress) const {
  auto options = gather_options(options_, options_.sensor_resolution);
  options.most_bytes = 0;
  const PointGather gather(mesh_, sensors, options);
  progress.begin("light from surfaces", sensors.size());
  const std::vector<std::uint8_t> all(sensors.size(), 1);
  const CornerLight& corners = light.corners;
  const std::vector<Rgb> sent = reflected_part(surfaces_, corners.radiosity);
  const auto lamps = light_of_lamps(emitters_, sensors, all, options_.lift_m, kLampRays);
  std::vector<PointGather::Looks> looks(sensors.size());
  std::vector<std::array<double, PointGather::kLooks>> mesh_part(sensors.size());
  gather.for_rows(all, [&](std::size_t i, std::size_t look, const FormFactorRow& row) {
    progress.stop_if_cancelled();
    Rgb sum = lamps[i].lux;
    if (surfaces_.any_emits) {
      sum = sum + emission_left_to_row(surfaces_, emitters_, lamps[i], row);
    }
    for (const FormFactor& f : row) sum = sum + f.value * sent[f.side];
    looks[i][look] = sum;
    mesh_part[i][look] = mesh_error_lux(row, corners.spread, corners.uneven);
  });
  const std::vector<std::uint32_t> one_plane(sensors.size());
  const std::vector<double> variance = pooled_variance(looks, one_plane, 1);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const double mesh_lux = 0.5 * (mesh_part[i][0] + mesh_part[i][1]);
    values.reflected_lux[i] = luminance_of(mean_of(looks[i]));
    values.error_lux[i] =
        std::hypot(values.error_lux[i], interval_lux(variance[i] + lamps[i].variance, mesh_lux)) +
        corners.convergence_lux;
  }
  progress.end(std::to_string(sensors.size()) + " sensors");
}

}  // namespace tenku
