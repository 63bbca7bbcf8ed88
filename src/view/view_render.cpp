#include "view/view_render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "core/parallel.h"
#include "illuminance/error_budget.h"
#include "illuminance/lamp_light.h"
#include "scene/soup_triangle.h"
#include "view/edge_pixels.h"
#include "view/picture_sky.h"
#include "view/pixel_paths.h"
#include "view/pixel_sharing.h"
#include "view/shading_points.h"

namespace tenku {
namespace {

constexpr double kBlock = 8.0;       // pixels a side that share reflected light on one surface
constexpr double kFarBlock_m = 5.0;  // width of a block beyond which surfaces share

/// Blocks of pixels are the cells in which the points of one surface share reflected light.
SharingLayout sharing_by_pixels(const ShadingPoints& points, const PerspectiveCamera& camera) {
  SharingLayout layout;
  layout.surface = points.surface;
  for (std::size_t i = 0; i < points.sensors.size(); ++i) {
    const auto [column, row] = points.pixel(i);
    layout.place.push_back({column / kBlock, row / kBlock, 0.0});
    const double away = length(points.sensors.position[i] - camera.eye());
    if (kBlock * camera.footprint_m(away) > kFarBlock_m) {
      layout.surface[i] = facing(points.sensors.normal[i]);
    }
  }
  layout.reach = 2;
  layout.must_see = false;
  layout.is_measured = false;  // over 8 pixels it would tell of far more than a pixel misses
  return layout;
}

IlluminanceOptions options_of(const ViewRequest& request) {
  IlluminanceOptions options;
  options.tolerance_pct = std::min(100.0, 12.0 * request.tolerance_pct);
  options.bounces = 0;
  options.floor_share = 0.01;  // darker is black in any picture
  options.first_slices = 8;    // averaged with the pixels around
  options.seed = request.seed;
  return options;
}

/// Finds skylight anew where it scatters too much for its mean over the pixels around: each point
/// by itself, from more slices each time, of which narrow windows are seen by few. Where many still
/// scatter then, it is not by chance.
void settle_sky(const ViewRequest& request, const ShadingPoints& points, const RayVisibility& rays,
                const DaylightSource& source, IlluminanceResult& light, Progress& progress) {
  if (source.partition) return;  // by hand
  constexpr int kFirst = 64, kMost = 1024;
  IlluminanceOptions options = options_of(request);
  options.tolerance_pct = std::min(100.0, ErrorBudget::kErrorsInTolerance * request.tolerance_pct);
  for (options.first_slices = kFirst; options.first_slices <= kMost; options.first_slices *= 4) {
    const auto scattered = scattered_sky(points, light.values, request.tolerance_pct / 100.0);
    const bool is_by_chance =
        options.first_slices == kFirst || 8 * scattered.size() < points.sensors.size();
    if (scattered.empty() || !is_by_chance) return;
    const IlluminanceResult finer =
        illuminate(sensors_of(points.sensors, scattered), rays, source, options, progress);
    for (std::size_t k = 0; k < scattered.size(); ++k) {
      light.values.sky_lux[scattered[k]] = finer.values.sky_lux[k];
      light.values.error_lux[scattered[k]] = finer.values.error_lux[k];
    }
    light.rays += finer.rays;
  }
}

/// A pixel's standard error is held to the tolerance; darker than a hundredth of the mean is black.
ErrorBudget lamp_budget(const ViewRequest& request, const SensorIlluminance& light) {
  double sum = 0.0;
  for (std::size_t i = 0; i < light.size(); ++i) sum += light.total_lux(i);
  return {std::min(100.0, ErrorBudget::kErrorsInTolerance * request.tolerance_pct),
          0.01 * sum / static_cast<double>(light.size())};
}

/// The triangles that the points lie on, and how large they would be in the picture.
SeenPolygons seen_polygons(const ShadingPoints& points, const PerspectiveCamera& camera,
                           const RayVisibility& rays) {
  SeenPolygons seen;
  std::unordered_map<std::uint64_t, std::uint32_t> place;
  const TriangleSoup& soup = rays.soup();
  const double pixel = camera.footprint_m(1.0);
  for (std::size_t i = 0; i < points.sensors.size(); ++i) {
    const Vec3 normal = points.sensors.normal[i];
    const std::uint32_t t = points.triangle[i];
    const bool is_front = dot(normal, rays.normal(t)) > 0.0;
    const auto [found, is_new] = place.emplace(2 * std::uint64_t{t} + (is_front ? 1 : 0),
                                               static_cast<std::uint32_t>(seen.normal.size()));
    seen.of_sensor.push_back(found->second);
    if (!is_new) continue;
    const Vec3 to_eye = camera.eye() - middle_of(soup, t);
    const double away = length(to_eye);
    seen.normal.push_back(normal);
    seen.pixels.push_back(area_m2(soup, t) * std::abs(dot(normal, to_eye)) / (away * away * away) /
                          (pixel * pixel));
  }
  return seen;
}

/// The sky, and beyond the edge of the scene an open ground of the usual reflectance.
Backdrop backdrop_of(const DaylightSource& source, const SkyModel* sky,
                     const Background* background) {
  constexpr double kGroundReflectance = 0.2;  // as gensky and most codes take it
  return {sky, Rgb::grey(kGroundReflectance * source.unobstructed_lux() / kPi), background};
}

/// What a picture asks to be lit, and how.
struct ViewWork {
  PerspectiveCamera camera;
  Backdrop backdrop;
  MirrorReport mirrors;
  std::unique_ptr<PixelPaths> paths;
  ShadingPoints points;
  SeenPolygons polygons;
  LightMethod method;

  ViewWork(const ViewRequest& request, const Engines& engines, const DaylightSource& source,
           const SkyModel* sky, Progress& progress)
      : camera(request.view),
        backdrop(backdrop_of(source, sky, request.background)),
        paths(pixel_paths(camera, engines.rays(), backdrop, request.mirrors, progress, mirrors)),
        points(find_shading_points(
            camera, engines.rays(), *paths,
            request.reflection != nullptr ? PointPlace::Middle : PointPlace::First, progress)),
        method(request.method) {
    method.eye = camera.eye();
    method.picture_tolerance_pct = request.tolerance_pct;
    if (method.detail != Detail::Paper) return;
    polygons = seen_polygons(points, camera, engines.rays());
    method.polygons = &polygons;
  }
  ViewWork(const ViewWork&) = delete;
  ViewWork& operator=(const ViewWork&) = delete;
};

/// Adds reflected light, and its error.
void add_reflected(const SensorIlluminance& part, SensorIlluminance& light) {
  for (std::size_t i = 0; i < light.size(); ++i) {
    light.set_reflected(i, light.reflected_rgb[i] + part.reflected_rgb[i]);
    light.error_lux[i] = std::hypot(light.error_lux[i], part.error_lux[i]);
  }
}

/// Light that ends at shadows.
/// @param find  is told the points only on edges
SensorIlluminance light_of_lamps(const PixelRays& pixels, double tolerance,
                                 const PlaceLightFinder& find) {
  SensorIlluminance lamps(pixels.points.sensors.size());
  find(pixels.points.sensors, {}, lamps);
  take_means_of_rays(pixels, points_on_edges(pixels.points, lamps, tolerance), find, lamps);
  return lamps;
}

/// Light between surfaces by the finder of the request: what varies slowly is shared, light of
/// lamps, with its shadows, is found for each point; both for each ray where a pixel is too coarse.
void add_found_reflection(const ViewRequest& request, const PixelRays& pixels,
                          SensorIlluminance& light, Progress& progress) {
  const double tolerance = request.tolerance_pct / 100.0;
  const SensorIlluminance lamps = light_of_lamps(
      pixels, tolerance, [&](const Sensors& places, auto point, SensorIlluminance& values) {
        const auto& found =
            point.empty() ? request.reflection->lamps : request.reflection->lamps_on_edges;
        found(places, values, progress);
      });
  const auto find_at = [&](const Sensors& places, std::span<const std::uint32_t> point, int mean_of,
                           SensorIlluminance& values) {
    for (std::size_t k = 0; k < point.size(); ++k) {
      values.sky_lux[k] = light.sky_lux[point[k]] + lamps.reflected_lux[point[k]];
    }
    request.reflection->without_lamps(places, mean_of, values, progress);
  };
  const auto find = [&](std::span<const std::uint32_t> chosen) {
    SensorIlluminance values(chosen.size());
    find_at(sensors_of(pixels.points.sensors, chosen), chosen, 1, values);
    return values;
  };
  SensorIlluminance shared(light.size());
  const auto untold = share_by_pixels(pixels.points, tolerance, find, shared);
  take_means_of_rays(
      pixels, untold,
      [&](const Sensors& places, auto point, SensorIlluminance& values) {
        find_at(places, point, static_cast<int>(kRayPlaces.size()), values);
      },
      shared);
  add_reflected(shared, light);
  add_reflected(lamps, light);
}

/// The same by paths.
/// @return  rays sent
std::uint64_t add_reflection_by_paths(const ViewRequest& request, const ViewWork& work,
                                      const RayVisibility& rays, const DaylightSource& source,
                                      IlluminanceResult& light, Progress& progress) {
  IlluminanceOptions options = options_of(request);
  options.bounces = request.bounces;
  options.lamps_apart = true;
  // Some twenty representatives are blended in a pixel.
  const ReflectedSharing sharing(work.points.sensors, sharing_by_pixels(work.points, work.camera),
                                 rays);
  add_shared_reflection(sharing, rays, source, options, progress, light);
  const ErrorBudget budget = lamp_budget(request, light.values);
  std::uint64_t sent = 0;
  const SensorIlluminance lamps =
      light_of_lamps({work.points, *work.paths, rays}, request.tolerance_pct / 100.0,
                     [&](const Sensors& places, auto, SensorIlluminance& values) {
                       sent += add_lamp_light(places, rays, budget, request.seed, progress, values);
                     });
  add_reflected(lamps, light.values);
  return sent;
}

/// Counts the pixels with points out of tolerance, and says so.
void tell_missed(const ShadingPoints& points, const std::vector<std::uint8_t>& missed,
                 RenderedView& result) {
  std::size_t& count = result.out_of_tolerance;
  for (std::size_t p = 0; p < points.background.size(); ++p) {
    const auto begin = missed.begin() + points.first[p], end = missed.begin() + points.first[p + 1];
    count += std::find(begin, end, std::uint8_t{1}) != end;
  }
  if (count == 0) return;
  Finding finding;
  finding.code = "tolerance_not_reached";
  finding.what = "pixels met the limit of effort before the tolerance";
  finding.repair = "a higher tolerance, or take them as they are";
  finding.count = count;
  result.findings.push_back(std::move(finding));
}

void compose(const ShadingPoints& points, const SensorIlluminance& light,
             const std::vector<Material>& materials, RenderedView& result) {
  const std::size_t pixels = result.luminance.pixels.size();
  std::vector<double> weight(pixels, 0.0), lux(pixels, 0.0), error(pixels, 0.0);
  for (std::size_t p = 0; p < pixels; ++p) result.luminance.pixels[p] = points.background[p];
  for (std::size_t i = 0; i < points.sensors.size(); ++i) {
    const std::size_t p = points.pixel_index[i];
    const Material& material = materials[points.material[i]];
    const Rgb leaving = material.emission_lm_m2 + light.total_rgb(i) * material.reflectance;
    result.luminance.pixels[p] =
        result.luminance.pixels[p] + (1.0 / kPi) * (points.weight[i] * leaving);
    if (!points.is_seen_directly[i]) continue;
    const double w = points.coverage[i];
    weight[p] += w;
    lux[p] += w * light.total_lux(i);
    error[p] += w * light.error_lux[i];
  }
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t p = 0; p < pixels; ++p) {
    const bool seen = weight[p] > 0.0;
    const double none = std::numeric_limits<double>::quiet_NaN();
    result.illuminance_lux.push_back(seen ? lux[p] / weight[p] : none);
    result.error_lux.push_back(seen ? error[p] / weight[p] : none);
    if (seen) sum += error[p] / weight[p], ++count;
  }
  result.error_mean = count > 0 ? sum / static_cast<double>(count) : 0.0;
}

/// Says of mirrors that reflect one another more often than is followed.
void tell_cut(const ShadingPoints& points, int depth, std::vector<Finding>& findings) {
  if (points.cut_pixels == 0) return;
  Finding finding;
  finding.code = "mirror_depth_reached";
  finding.what = fmt::format(
      "pixels show more than {} mirrors in a row; there up to {:.2g} of the light beyond is "
      "missing",
      depth, points.cut_share);
  finding.repair = "a greater --depth";
  finding.count = points.cut_pixels;
  findings.push_back(std::move(finding));
}

}  // namespace

RenderedView render_view(const ViewRequest& request, const Engines& engines,
                         const DaylightSource& source, const SkyModel* sky, Progress& progress) {
  const ViewWork work(request, engines, source, sky, progress);
  const ShadingPoints& points = work.points;
  IlluminanceResult light =
      illuminate(points.sensors, engines, source, options_of(request), work.method, progress);
  if (request.reflection != nullptr) {
    settle_sky(request, points, engines.rays(), source, light, progress);
  }
  smooth_sky(points, light.values);
  if (request.reflection != nullptr && points.sensors.size() > 0) {
    add_found_reflection(request, {points, *work.paths, engines.rays()}, light.values, progress);
  } else if (request.bounces > 0 && points.sensors.size() > 0) {
    light.rays += add_reflection_by_paths(request, work, engines.rays(), source, light, progress);
  }
  RenderedView result;
  result.luminance = Image(work.camera.width(), work.camera.height());
  result.rays = points.rays + light.rays;
  result.regions = light.regions;
  result.findings = work.mirrors.findings;
  if (request.mirrors.method != MirrorMethod::Off) {
    tell_cut(points, request.mirrors.depth, result.findings);
  }
  tell_missed(points, light.is_missed, result);
  compose(points, light.values, engines.rays().materials(), result);
  return result;
}

ViewPlan plan_view(const ViewRequest& request, const Engines& engines, const DaylightSource& source,
                   Progress& progress) {
  ViewWork work(request, engines, source, nullptr, progress);
  work.method.is_predicted = true;
  IlluminanceOptions options = options_of(request);
  ViewPlan plan;
  for (RegionWork& region :
       plan_light(work.points.sensors, engines, source, options, work.method, progress)) {
    plan.regions.push_back(std::move(region.told));
  }
  if (request.bounces == 0 || work.points.sensors.size() == 0) return plan;
  options.bounces = request.bounces;
  options.lamps_apart = true;
  const ReflectedSharing sharing(work.points.sensors, sharing_by_pixels(work.points, work.camera),
                                 engines.rays());
  plan.reflection_s = predicted_reflection_s(sensors_of(work.points.sensors, sharing.calculated()),
                                             engines.rays(), source, options);
  return plan;
}

}  // namespace tenku
