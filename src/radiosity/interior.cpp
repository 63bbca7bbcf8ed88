#include "radiosity/interior.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/parallel.h"
#include "core/stopwatch.h"
#include "illuminance/error_budget.h"

namespace tenku {
namespace {

constexpr double kShotShare = 0.1;   // of the tolerance: what shots may leave unshot
constexpr double kSweepShare = 0.1;  // of the tolerance and the mean light: left by sweeps
constexpr std::size_t kMostSweeps = 100, kGrain = 16;
constexpr int kPointEmitterRays = 64, kSensorEmitterRays = 400;  // to a lamp seen in part

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

Rgb mean_of(const PointGather::Looks& looks) { return 0.5 * (looks[0] + looks[1]); }

void add(std::vector<PointGather::Looks>& looks, const std::vector<PointGather::Looks>& more) {
  for (std::size_t i = 0; i < looks.size(); ++i) {
    for (std::size_t k = 0; k < PointGather::kLooks; ++k) looks[i][k] = looks[i][k] + more[i][k];
  }
}

/// Half the difference of the looks: one draw of the error of their mean.
double draw_of_error(const PointGather::Looks& looks) {
  return 0.5 * (luminance_of(looks[0]) - luminance_of(looks[1]));
}

/// Variance of each point, lux^2: half its own draw, half that of its plane in proportion.
std::vector<double> pooled_variance(const std::vector<PointGather::Looks>& looks,
                                    std::span<const std::uint32_t> plane, std::uint32_t planes) {
  std::vector<double> squares(planes), values(planes);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    squares[plane[i]] += std::pow(draw_of_error(looks[i]), 2);
    values[plane[i]] += std::pow(luminance_of(mean_of(looks[i])), 2);
  }
  std::vector<double> variance;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const double share = values[plane[i]] > 0.0 ? squares[plane[i]] / values[plane[i]] : 0.0;
    variance.push_back(0.5 * std::pow(draw_of_error(looks[i]), 2) +
                       0.5 * share * std::pow(luminance_of(mean_of(looks[i])), 2));
  }
  return variance;
}

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
      emitters_(mesh, surfaces_, options.shot.seed) {}

std::vector<EmitterLight::Direct> Interior::straight(const Sensors& sensors,
                                                     std::span<const std::uint8_t> is_wanted,
                                                     int rays) const {
  std::vector<EmitterLight::Direct> light(sensors.size());
  if (!emitters_.is_any()) return light;
  parallel_for(sensors.size(), kGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (is_wanted[i] == 0) continue;
      const Vec3 normal = sensors.normal[i];
      light[i] = emitters_.at(sensors.position[i] + options_.lift_m * normal, normal, rays);
    }
  });
  return light;
}

Rgb Interior::left_to_row(const EmitterLight::Direct& straight, const FormFactorRow& row) const {
  Rgb sum;
  for (const FormFactor& f : row) {
    const std::uint32_t e = f.side / 2;
    if (!surfaces_.emits(e) || straight.has(emitters_.patch_of(e))) continue;
    sum = sum + f.value * surfaces_.emission_lm_m2[e];
  }
  return sum;
}

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
  sweep(direct, light);
  times_.solve_s += sweeping.seconds();
  return light;
}

std::vector<Rgb> Interior::without_emission(std::span<const Rgb> radiosity) const {
  std::vector<Rgb> reflected(radiosity.begin(), radiosity.end());
  for (std::size_t s = 0; s < reflected.size(); ++s) {
    reflected[s] = reflected[s] + -1.0 * surfaces_.emission_lm_m2[s / 2];
  }
  return reflected;
}

void Interior::sweep(const DaylightOnSides& direct, InteriorLight& light) {
  light.radiosity = light.shots.sides.radiosity;
  light.reflected.assign(points_.size(), {});
  std::vector<PointGather::Looks> looks;
  const auto lamps = straight(points_.sensors, light.is_lit, kPointEmitterRays);
  std::vector<PointGather::Looks> emitted(points_.size());
  if (surfaces_.any_emits) {
    gather_.for_rows(light.is_lit, [&](std::size_t i, std::size_t look, const FormFactorRow& row) {
      emitted[i][look] = lamps[i].lux + left_to_row(lamps[i], row);
    });
  }
  std::vector<Rgb> sent;
  const double rho = surfaces_.most_reflectance;
  for (bool done = false; !done; ++light.sweeps) {
    sent = without_emission(light.radiosity);
    looks = gather_.gather(sent, light.is_lit);
    add(looks, emitted);
    double change = 0.0, sum = 0.0, lit = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Rgb now = mean_of(looks[i]);
      change = std::max(change, std::abs(luminance_of(now) - luminance_of(light.reflected[i])));
      light.reflected[i] = now;
      sum += direct.points.total_lux(i) + luminance_of(now);
      lit += light.is_lit[i];
    }
    for (std::size_t s = 0; s < mesh_.sides(); ++s) {
      const auto& [a, b, c] = points_.corner[s];
      if (light.is_lit[a] == 0) continue;
      const Rgb corners =
          (1.0 / 3.0) * (light.reflected[a] + light.reflected[b] + light.reflected[c]);
      light.radiosity[s] = surfaces_.emission_lm_m2[s / 2] +
                           surfaces_.reflectance[s / 2] * (Rgb::grey(direct.lux[s]) + corners);
    }
    light.convergence_lux = rho / (1.0 - rho) * change;
    const double enough = kSweepShare * options_.tolerance_pct / 100.0 * sum / std::max(lit, 1.0);
    done = light.sweeps > 0 && (light.convergence_lux <= enough || light.sweeps + 1 >= kMostSweeps);
  }
  light.unsure.assign(mesh_.sides(), 0.0);
  for (std::size_t s = 0; s < mesh_.sides(); ++s) {
    const auto& [a, b, c] = points_.corner[s];
    const double ea = luminance_of(light.reflected[a]), eb = luminance_of(light.reflected[b]),
                 ec = luminance_of(light.reflected[c]);
    const double spread = std::max({ea, eb, ec}) - std::min({ea, eb, ec});
    light.unsure[s] =
        luminance_of(surfaces_.reflectance[s / 2]) * (0.25 * direct.uneven_lux[s] + 0.1 * spread);
  }
  std::vector<Rgb> unsure;
  for (const double u : light.unsure) unsure.push_back(Rgb::grey(u));
  const auto mesh_part = gather_.gather(unsure, light.is_lit);
  const std::vector<double> variance = pooled_variance(looks, points_.plane, points_.planes);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    light.points.reflected_lux[i] = luminance_of(light.reflected[i]);
    light.points.error_lux[i] =
        std::hypot(light.points.error_lux[i], interval_lux(variance[i] + lamps[i].variance,
                                                           luminance_of(mean_of(mesh_part[i])))) +
        light.convergence_lux;
  }
}

void Interior::add_reflected(const Sensors& sensors, const InteriorLight& light,
                             SensorIlluminance& values, Progress& progress) const {
  auto options = gather_options(options_, options_.sensor_resolution);
  options.most_bytes = 0;
  const PointGather gather(mesh_, sensors, options);
  progress.begin("light from surfaces", sensors.size());
  const std::vector<std::uint8_t> all(sensors.size(), 1);
  const std::vector<Rgb> sent = without_emission(light.radiosity);
  const auto lamps = straight(sensors, all, kSensorEmitterRays);
  std::vector<PointGather::Looks> looks(sensors.size()), mesh_part(sensors.size());
  gather.for_rows(all, [&](std::size_t i, std::size_t look, const FormFactorRow& row) {
    progress.stop_if_cancelled();
    looks[i][look] = lamps[i].lux;
    if (surfaces_.any_emits) looks[i][look] = looks[i][look] + left_to_row(lamps[i], row);
    for (const FormFactor& f : row) {
      looks[i][look] = looks[i][look] + f.value * sent[f.side];
      mesh_part[i][look].g += f.value * light.unsure[f.side];
    }
  });
  const std::vector<std::uint32_t> one_plane(sensors.size());
  const std::vector<double> variance = pooled_variance(looks, one_plane, 1);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    values.reflected_lux[i] = luminance_of(mean_of(looks[i]));
    values.error_lux[i] =
        std::hypot(values.error_lux[i],
                   interval_lux(variance[i] + lamps[i].variance, mean_of(mesh_part[i]).g)) +
        light.convergence_lux;
  }
  progress.end(std::to_string(sensors.size()) + " sensors");
}

}  // namespace tenku
