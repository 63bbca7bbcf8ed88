#include "flythrough/point_lighting.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <unordered_map>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "illuminance/planned_light.h"
#include "illuminance/shared_light.h"

namespace tenku {
namespace {

// As render_view has them: what pixels share may each be that much less exact.
constexpr double kAveraged = 12.0;
constexpr double kFloorShare = 0.01;
constexpr int kFirstSlices = 8;
constexpr double kBlock = 8.0;       // footprints of a cell that shares reflected light
constexpr double kFarBlock_m = 5.0;  // width of a cell beyond which surfaces share
// Footprints of a cell that shares how another sun and sky change skylight, and reflected light.
constexpr double kSkyBlock = 8.0, kReflectedBlock = 24.0;
constexpr double kNear = 1.5;  // footprints within which skylight is averaged

/// Points that need about the same exactness, from the most to the least.
constexpr std::array<double, 3> kClassPixels{0.75, 0.375, 0.0};

Sensors sensors_of(const StoredPoints& points) { return {points.position, points.normal}; }

IlluminanceOptions options_of(const PointLightOptions& how, double looser) {
  IlluminanceOptions options;
  options.tolerance_pct = std::min(100.0, kAveraged * how.tolerance_pct * looser);
  options.bounces = 0;
  options.floor_share = kFloorShare;
  options.first_slices = kFirstSlices;
  options.seed = how.seed;
  return options;
}

/// Octave of a length.
int octave(double length) { return static_cast<int>(std::floor(std::log2(length))); }

/// Points in cubes twice as wide as the reach of an average, apart by surface and octave.
class Neighbours {
 public:
  explicit Neighbours(const StoredPoints& points) : points_(points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double side = side_m(i);
      const Vec3 p = points.position[i];
      const std::array<std::int64_t, 3> cell{cell_of(p.x / side), cell_of(p.y / side),
                                             cell_of(p.z / side)};
      cells_[key(i, cell)].push_back(static_cast<std::uint32_t>(i));
    }
  }

  template <class Visit>
  void for_each(std::size_t i, const Visit& visit) const {
    const double side = side_m(i), reach = kNear * double{points_.footprint_m[i]};
    const Vec3 p = points_.position[i];
    const std::array<double, 3> at{p.x / side, p.y / side, p.z / side};
    for (int corner = 0; corner < 8; ++corner) {
      std::array<std::int64_t, 3> cell{};
      for (std::size_t a = 0; a < 3; ++a) {
        const bool is_upper = (corner >> a & 1) != 0;
        cell[a] = cell_of(at[a] - 0.5) + (is_upper ? 1 : 0);
      }
      const auto found = cells_.find(key(i, cell));
      if (found == cells_.end()) continue;
      for (const std::uint32_t k : found->second) {
        if (length(points_.position[k] - p) <= reach && is_one_surface(i, k)) visit(k);
      }
    }
  }

 private:
  double side_m(std::size_t i) const {
    return 2.0 * kNear * std::exp2(octave(points_.footprint_m[i]) + 1);
  }
  static std::int64_t cell_of(double v) { return static_cast<std::int64_t>(std::floor(v)); }
  std::uint64_t key(std::size_t i, const std::array<std::int64_t, 3>& cell) const {
    const auto level = static_cast<std::uint64_t>(octave(points_.footprint_m[i]) + 64);
    std::uint64_t bits = mix_bits(level);
    for (const std::int64_t c : cell) bits = mix_bits(bits + static_cast<std::uint64_t>(c));
    return bits;
  }
  bool is_one_surface(std::size_t i, std::size_t k) const {
    const Vec3 n = points_.normal[i];
    return points_.object[i] == points_.object[k] && dot(n, points_.normal[k]) > 0.99 &&
           std::abs(dot(n, points_.position[k] - points_.position[i])) <
               0.3 * double{points_.footprint_m[i]};
  }

  const StoredPoints& points_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

void smooth_sky(const StoredPoints& points, SensorIlluminance& light) {
  const Neighbours neighbours(points);
  const std::vector<double> sky = light.sky_lux, view = light.sky_view;
  parallel_for(points.size(), 1024, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      double sum = 0.0, views = 0.0;
      std::size_t count = 0;
      neighbours.for_each(i, [&](std::size_t k) {
        sum += sky[k];
        views += view[k];
        ++count;
      });
      light.sky_lux[i] = sum / static_cast<double>(count);
      light.sky_view[i] = views / static_cast<double>(count);
    }
  });
}

/// Cells of two octaves of footprints, so that fine points on edges share with those beside them.
SharingLayout sharing_by_footprint(const StoredPoints& points, double block) {
  SharingLayout layout;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int level = static_cast<int>(std::floor(0.5 * (octave(points.footprint_m[i]) + 1)));
    const double side = block * std::exp2(2 * level);
    layout.place.push_back((1.0 / side) * points.position[i]);
    const Vec3 n = points.normal[i];
    std::uint64_t surface = facing(n);
    if (side < kFarBlock_m) {
      surface = mix_rounded(mix_bits(surface), {2.0 * dot(n, points.position[i]) / side});
    }
    layout.surface.push_back(mix_bits(surface + static_cast<std::uint64_t>(level + 64)));
  }
  layout.reach = 1;
  layout.must_see = false;
  layout.is_measured = false;
  return layout;
}

/// Lights the points of one class, and puts the light where it belongs.
class DirectLight {
 public:
  DirectLight(const Engines& engines, const DaylightSource& source,
              const PointLightOptions& options, const PointLightPlan& plan)
      : engines_(engines), source_(source), options_(options), plan_(plan) {}

  SensorIlluminance light(const Sensors& sensors, double looser, Progress& progress) const {
    return plan_.is_shared ? by_shared(sensors, looser, progress)
                           : by_slices(sensors, looser, progress);
  }

  /// Sunlight alone.
  std::vector<double> sun_lux(const Sensors& sensors) const {
    const double lux = source_.sun.normal_illuminance.value();
    if (!(lux > 0.0)) return std::vector<double>(sensors.size(), 0.0);
    constexpr std::size_t kUsual = 8;
    const std::size_t directions = plan_.sun_directions > 0 ? plan_.sun_directions : kUsual;
    return shared_sun_lux(engines_.rays(), lifted(sensors, engines_.rays().lift_m()), source_.sun,
                          static_cast<int>(directions));
  }

 private:
  SensorIlluminance by_slices(const Sensors& sensors, double looser, Progress& progress) const {
    return illuminate(sensors, engines_.rays(), source_, options_of(options_, looser), progress)
        .values;
  }

  SensorIlluminance by_shared(const Sensors& sensors, double looser, Progress& progress) const {
    SkyPartition partition;
    if (source_.model != nullptr) partition = partition_sky(*source_.model, request(looser));
    const Sensors at = lifted(sensors, engines_.rays().lift_m());
    const SharedElements elements(partition, source_.sky.get());
    const int suns = static_cast<int>(plan_.sun_directions);
    SharedLight light;
    if (plan_.engine == Engine::Rays) {
      light = shared_light(engines_.rays(), engines_.rays(), at, source_, elements, suns, progress);
    } else {
      const ShadowMaps maps = engines_.maps().with(plan_.texels);
      light = shared_light(maps, maps, at, source_, elements, suns, progress);
    }
    SensorIlluminance values(sensors.size());
    values.sun_lux = std::move(light.sun_lux);
    values.sky_lux = std::move(light.sky_lux);
    values.sky_view = std::move(light.sky_view);
    return values;
  }

  /// The error of elements falls with their number.
  PartitionRequest request(double looser) const {
    PartitionRequest wanted;
    if (source_.partition) wanted = *source_.partition;
    if (plan_.elements == 0) return wanted;
    wanted = {};
    wanted.method = PartitionMethod::Energy;
    constexpr double kFewest = 33.0;
    wanted.elements =
        static_cast<std::size_t>(std::max(std::min(kFewest, static_cast<double>(plan_.elements)),
                                          static_cast<double>(plan_.elements) / looser));
    return wanted;
  }

  const Engines& engines_;
  const DaylightSource& source_;
  const PointLightOptions& options_;
  const PointLightPlan& plan_;
};

/// Direct light of all, class by class.
SensorIlluminance direct_light(const StoredPoints& points, const std::vector<double>& pixels,
                               const DirectLight& by, Progress& progress) {
  const Sensors all = sensors_of(points);
  SensorIlluminance values(points.size());
  for (std::size_t c = 0; c < kClassPixels.size(); ++c) {
    const double most = c == 0 ? 1e300 : kClassPixels[c - 1];
    std::vector<std::uint32_t> chosen;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      if (pixels[i] >= kClassPixels[c] && pixels[i] < most) chosen.push_back(i);
    }
    if (chosen.empty()) continue;
    const auto some =
        by.light(sensors_of(all, chosen), std::exp2(static_cast<double>(c)), progress);
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      values.sun_lux[chosen[k]] = some.sun_lux[k];
      values.sky_lux[chosen[k]] = some.sky_lux[k];
      values.sky_view[chosen[k]] = some.sky_view[k];
    }
  }
  return values;
}

PointLight stored(const SensorIlluminance& values) {
  PointLight light(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    light.sun_lux[i] = static_cast<float>(values.sun_lux[i]);
    light.sky_lux[i] = static_cast<float>(values.sky_lux[i]);
    light.reflected_lux[i] = values.reflected_rgb[i];
    light.sky_view[i] = static_cast<float>(values.sky_view[i]);
  }
  return light;
}

double ratio_of(double now, double then) { return then > 0.0 ? now / then : 0.0; }

/// Finds for a few points how another sun and sky change their light, and tells it to all.
class LightChange {
 public:
  LightChange(const StoredPoints& points, const PointLight& before, const Engines& engines)
      : points_(points), sensors_(sensors_of(points)), before_(before), engines_(engines) {}

  /// Skylight of all points.
  std::vector<double> sky_lux(const DirectLight& by, Progress& progress) const {
    const bool had_sky = std::any_of(before_.sky_lux.begin(), before_.sky_lux.end(),
                                     [](float lux) { return lux > 0.0F; });
    if (!had_sky) return by.light(sensors_, 1.0, progress).sky_lux;
    const ReflectedSharing sharing(sensors_, sharing_by_footprint(points_, kSkyBlock),
                                   engines_.rays());
    const auto& chosen = sharing.calculated();
    const SensorIlluminance now = by.light(sensors_of(sensors_, chosen), 1.0, progress);
    // Blends are linear: one serves both.
    SensorIlluminance few(chosen.size()), all(points_.size());
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      few.set_reflected(k, {now.sky_lux[k], double{before_.sky_lux[chosen[k]]}, 0.0});
    }
    sharing.spread(few, all);
    std::vector<double> sky;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Rgb both = all.reflected_rgb[i];
      sky.push_back(before_.sky_lux[i] * ratio_of(both.r, both.g));
    }
    return sky;
  }

  /// Adds reflected light to what has its direct light.
  void add_reflected(const DaylightSource& source, IlluminanceOptions how,
                     SensorIlluminance& values, Progress& progress) const {
    const ReflectedSharing sharing(sensors_, sharing_by_footprint(points_, kReflectedBlock),
                                   engines_.rays());
    const auto& chosen = sharing.calculated();
    IlluminanceOptions::KnownDirect known;
    for (const std::uint32_t i : chosen) {
      known.lux.push_back(values.sun_lux[i] + values.sky_lux[i]);
      known.sky_view.push_back(values.sky_view[i]);
    }
    how.known_direct = &known;
    const SensorIlluminance now =
        illuminate(sensors_of(sensors_, chosen), engines_.rays(), source, how, progress).values;
    const bool had_any = std::any_of(before_.reflected_lux.begin(), before_.reflected_lux.end(),
                                     [](Rgb lux) { return luminance_of(lux) > 0.0; });
    if (!had_any) return sharing.spread(now, values);
    SensorIlluminance then(chosen.size());
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      then.set_reflected(k, before_.reflected_lux[chosen[k]]);
    }
    const std::vector<Rgb> ratio = blended_ratio(sharing, now, then);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values.set_reflected(i, before_.reflected_lux[i] * ratio[i]);
    }
  }

 private:
  /// Of blends, not a blend of ratios: where one of the few is dark it says little.
  std::vector<Rgb> blended_ratio(const ReflectedSharing& sharing, const SensorIlluminance& now,
                                 const SensorIlluminance& then) const {
    SensorIlluminance all_now(points_.size()), all_then(points_.size());
    sharing.spread(now, all_now);
    sharing.spread(then, all_then);
    std::vector<Rgb> ratio;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Rgb a = all_now.reflected_rgb[i], b = all_then.reflected_rgb[i];
      ratio.push_back({ratio_of(a.r, b.r), ratio_of(a.g, b.g), ratio_of(a.b, b.b)});
    }
    return ratio;
  }

  const StoredPoints& points_;
  Sensors sensors_;
  const PointLight& before_;
  const Engines& engines_;
};

}  // namespace

std::string text_of(const PointLightPlan& plan) {
  if (!plan.is_shared) return "slices";
  return fmt::format("shared {} {} {} {}", name_of(plan.engine), plan.elements, plan.sun_directions,
                     plan.texels);
}

PointLightPlan plan_of(const std::string& text) {
  if (text == "slices") return {};
  PointLightPlan plan;
  plan.is_shared = true;
  char engine[16] = "", rest = 0;
  const int read = std::sscanf(text.c_str(), "shared %15s %zu %zu %d%c", engine, &plan.elements,
                               &plan.sun_directions, &plan.texels, &rest);
  const bool is_maps = engine == std::string(name_of(Engine::ShadowMaps));
  if (read != 4 || !(is_maps || engine == std::string(name_of(Engine::Rays)))) {
    throw InputError("'" + text + "' is not how points are lit");
  }
  if (is_maps) plan.engine = Engine::ShadowMaps;
  return plan;
}

PointLightPlan plan_point_light(const StoredPoints& points, const Engines& engines,
                                const DaylightSource& source, const PointLightOptions& options,
                                const LightMethod& method, Progress& progress) {
  PointLightPlan plan;
  if (points.empty()) return plan;
  LightMethod how = method;
  how.picture_tolerance_pct = options.tolerance_pct;
  // The paper's rule is that of `pixels_at_closest`, and needs no polygons.
  if (how.detail == Detail::Paper) how.detail = Detail::Off;
  double most = 0.0;
  for (const RegionWork& region :
       plan_light(sensors_of(points), engines, source, options_of(options, 1.0), how, progress)) {
    const PlannedRegion& told = region.told;
    if (!(static_cast<double>(told.sensors) > most)) continue;
    most = static_cast<double>(told.sensors);
    plan = {told.is_shared, told.engine, told.elements, told.sun_directions, told.texels};
  }
  if (!plan.is_shared) return {};
  if (source.elements && plan.elements == source.elements->size()) plan.elements = 0;
  return plan;
}

PointLight light_points(const StoredPoints& points, const std::vector<double>& pixels,
                        const Engines& engines, const DaylightSource& source,
                        const PointLightOptions& options, const PointLightPlan& plan,
                        Progress& progress) {
  IlluminanceResult light;
  light.values =
      direct_light(points, pixels, DirectLight(engines, source, options, plan), progress);
  if (!plan.is_shared) smooth_sky(points, light.values);
  if (options.bounces > 0) {
    IlluminanceOptions how = options_of(options, 1.0);
    how.bounces = options.bounces;
    const Sensors sensors = sensors_of(points);
    light.is_missed.resize(points.size());
    const ReflectedSharing sharing(sensors, sharing_by_footprint(points, kBlock), engines.rays());
    add_shared_reflection(sharing, engines.rays(), source, how, progress, light);
  }
  return stored(light.values);
}

PointLight relight_points(const StoredPoints& points, const PointLight& before,
                          const Engines& engines, const DaylightSource& source,
                          const PointLightOptions& options, const PointLightPlan& plan,
                          Progress& progress) {
  const DirectLight by(engines, source, options, plan);
  const LightChange change(points, before, engines);
  SensorIlluminance values(points.size());
  values.sun_lux = by.sun_lux(sensors_of(points));
  values.sky_lux = change.sky_lux(by, progress);
  values.sky_view.assign(before.sky_view.begin(), before.sky_view.end());
  if (options.bounces > 0) {
    IlluminanceOptions how = options_of(options, 1.0);
    how.bounces = options.bounces;
    change.add_reflected(source, how, values, progress);
  }
  return stored(values);
}

}  // namespace tenku
