#include "illuminance/light_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "core/extent.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/stopwatch.h"
#include "illuminance/error_budget.h"
#include "illuminance/sensor_cells.h"
#include "illuminance/sensor_regions.h"
#include "illuminance/shared_light.h"
#include "illuminance/sky_interpolation.h"

namespace tenku {
namespace {

constexpr std::size_t kPilots = 200;        // a region
constexpr double kFinerPilots = 4.0;        // times the tolerance of what they are to judge
constexpr double kFinestPilots = 0.1;       // percent
constexpr std::size_t kFewSensors = 20000;  // are lit before a plan is made
// A plan is only made where what it may save is more than what it takes: by rays for each sensor.
constexpr double kSoon_s = 10.0, kSoonPicture_s = 1.0;
constexpr double kWorthMaps_s = 20.0;  // by rays; to try maps takes some seconds in software
constexpr double kNever = std::numeric_limits<double>::infinity();

// Maps.
constexpr double kTexelPerPercent_m = 0.35;  // of tolerance
constexpr double kFinestTexel_m = 0.1, kCoarsestTexel_m = 8.0;
constexpr int kLeastTexels = 128, kMostTexels = 2048, kUsualTexels = 1024;
constexpr double kAlone =
    2.0;  // such maps hold no more texels than four times those of each sensor by itself
constexpr std::size_t kClusters = 4;
constexpr double kInCluster = 2000.0;                    // sensors
constexpr std::size_t kFewTrials = 2, kMoreTrials = 10;  // elements that tell the time of maps,
constexpr std::size_t kRayTrials = 16;                   // and of rays

// Elements.
constexpr std::size_t kFewestElements = 33, kMostElements = 4096;
constexpr double kMoreElements = 1.4142135623730951;
constexpr double kDark = 0.05;         // of the unobstructed light
constexpr double kNearShare = 0.5;     // of that, for the near half; the far one has what is left
constexpr double kPictureShare = 0.3;  // of the tolerance, for the mean error of a picture
constexpr double kBright = 4.0;        // times the mean light of a picture
constexpr double kPartOfReach = 0.1;   // of the tolerance, for casters that are left out

double texel_of(double tolerance_pct) {
  return std::clamp(kTexelPerPercent_m * tolerance_pct, kFinestTexel_m, kCoarsestTexel_m);
}

std::size_t directions_on_sun(const DaylightSource& source, double tolerance_pct) {
  if (!(source.sun.normal_illuminance.value() > 0.0)) return 0;
  // 0.4 / n^0.75 of the sun is uncertain in a penumbra (shared_sun_lux); half of the tolerance.
  const double n = std::pow(0.8 / (tolerance_pct / 100.0), 4.0 / 3.0);
  return static_cast<std::size_t>(std::clamp(std::ceil(n), 4.0, 32.0));
}

/// What a region needs to know of the light.
class RegionPlanner {
 public:
  RegionPlanner(const Sensors& sensors, const Engines& engines, const DaylightSource& source,
                const IlluminanceOptions& options, const LightMethod& method)
      : sensors_(sensors), engines_(engines), source_(source), options_(options), method_(method) {}

  void plan(RegionWork& work) const {
    PlannedRegion& told = work.told;
    told.sensors = work.sensor.size();
    const Sensors here = sensors_of(sensors_, work.sensor);
    choose_pilots(work);
    const Sensors pilots = sensors_of(here, work.pilots.sensor);
    const bool may_rays = method_.engine != EngineChoice::ShadowMaps;
    bool may_maps = method_.engine != EngineChoice::Rays;
    const bool may_choose = may_rays && may_maps;
    const bool is_timed = method_.is_predicted || may_choose || (may_rays && is_picture());
    const bool may_be_apart = may_rays && method_.detail == Detail::Budget;
    if (may_be_apart || (method_.is_predicted && method_.detail == Detail::Budget)) {
      time_rays(pilots, told);
      told.elements = source_.element_count();
      choose_interpolation(here, told);
      if (!method_.is_predicted && told.rays_s < (is_picture() ? kSoonPicture_s : kSoon_s)) {
        told.why = "done soon";
        return;
      }
    }
    RegionWork shared = work;
    PlannedRegion& other = shared.told;
    other.is_shared = true;
    choose_maps(shared, here);
    const Sensors at = lifted(here, engines_.rays().lift_m());
    double ray_s = kNever, map_s = kNever;  // a direction
    if (is_timed && may_rays) ray_s = seconds_a_direction(Engine::Rays, at, other);
    if (may_choose && !method_.is_predicted) {
      const double all = may_be_apart ? told.rays_s : ray_s * static_cast<double>(elements_asked());
      may_maps = all > kWorthMaps_s;
    }
    if (is_timed && may_maps) map_s = seconds_a_direction(Engine::ShadowMaps, at, other);
    const double worth = may_be_apart ? told.rays_s / std::min(ray_s, map_s) : kNever;
    const bool is_enough = choose_elements(shared, pilots, worth);
    if (is_enough && std::isfinite(map_s) && std::isfinite(other.reach_m)) {
      map_s = seconds_a_direction(Engine::ShadowMaps, at, other);
    }
    if (is_enough && is_timed && may_rays) other.shared_s = ray_s * maps_of(other);
    if (is_enough && is_timed && may_maps) other.maps_s = map_s * maps_of(other);
    told.shared_s = other.shared_s, told.maps_s = other.maps_s;
    const bool maps_win = may_maps && (!may_rays || other.maps_s < other.shared_s);
    const double best = maps_win ? other.maps_s : other.shared_s;
    if (!may_be_apart || (is_enough && best < told.rays_s)) work = shared;
    if (work.told.is_shared && maps_win) work.told.engine = Engine::ShadowMaps;
    work.told.why = may_choose ? "sooner done" : "asked for";
  }

 private:
  /// By hand, or about as many as most tolerances need.
  std::size_t elements_asked() const {
    constexpr std::size_t kUsual = 512;
    return source_.elements ? source_.elements->size() : kUsual;
  }
  bool is_picture() const { return method_.picture_tolerance_pct > 0.0; }
  static double maps_of(const PlannedRegion& told) {
    return static_cast<double>(told.elements + told.sun_directions);
  }

  void choose_pilots(RegionWork& work) const {
    const std::size_t count = std::min(kPilots, work.sensor.size());
    SampleRandom random(options_.seed, work.sensor.size(), 0x70696c6f74ULL);
    std::vector<std::uint32_t>& chosen = work.pilots.sensor;
    // One in each of as many equal runs of sensors: all parts of the region have theirs.
    for (std::size_t k = 0; k < count; ++k) {
      const double at = (static_cast<double>(k) + random.uniform()) / static_cast<double>(count);
      const auto place = static_cast<std::size_t>(at * static_cast<double>(work.sensor.size()));
      chosen.push_back(static_cast<std::uint32_t>(std::min(place, work.sensor.size() - 1)));
    }
  }

  IlluminanceOptions direct_options() const {
    IlluminanceOptions direct = options_;
    direct.bounces = 0;
    direct.share_reflected_m = 0.0;
    return direct;
  }

  void time_rays(const Sensors& pilots, PlannedRegion& told) const {
    Progress quiet;
    const Stopwatch watch;
    const IlluminanceResult result =
        illuminate(pilots, engines_.rays(), source_, direct_options(), quiet);
    told.rays_s =
        watch.seconds() * static_cast<double>(told.sensors) / static_cast<double>(pilots.size());
    told.predicted_error_lux = result.values.mean_error_lux();
  }

  /// How many of the sensors take their skylight from others, found for some clusters of them.
  void choose_interpolation(const Sensors& here, PlannedRegion& told) const {
    told.may_interpolate = !is_picture() && told.sensors >= kFewSensors;
    if (!told.may_interpolate || told.rays_s < kWorthMaps_s) return;
    const Sensors sample = sensors_of(here, clusters_of(here));
    std::size_t interpolated = 0;
    Progress quiet;
    illuminate_sparsely(sample, engines_.rays(), source_, direct_options(), quiet, &interpolated);
    told.rays_s *= 1.0 - static_cast<double>(interpolated) / static_cast<double>(sample.size());
  }

  static std::vector<std::uint32_t> clusters_of(const Sensors& here) {
    const std::vector<std::uint64_t> any(here.size(), 0);
    const double cell_m = cell_with(kInCluster, here, any);
    SensorCells cells(places_in_cells(here, cell_m), any, 0);
    for (std::uint32_t s = 0; s < here.size(); ++s) cells.add(s, s);
    std::vector<std::uint32_t> chosen;
    for (std::size_t k = 0; k < kClusters; ++k) {
      const auto& cluster = cells.beside((2 * k + 1) * here.size() / (2 * kClusters));
      chosen.insert(chosen.end(), cluster.begin(), cluster.end());
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    return chosen;
  }

  void judge_pilots(RegionWork& work, const Sensors& pilots) const {
    Progress quiet;
    IlluminanceOptions finer = direct_options();
    finer.by_slices = true;
    finer.tolerance_pct = std::max(kFinestPilots, options_.tolerance_pct / kFinerPilots);
    const IlluminanceResult truth = illuminate(pilots, engines_.rays(), source_, finer, quiet);
    for (std::size_t k = 0; k < pilots.size(); ++k) {
      work.pilots.lux.push_back(truth.values.total_lux(k));
    }
  }

  void choose_maps(RegionWork& work, const Sensors& here) const {
    PlannedRegion& told = work.told;
    const Extent box = extent_of(here.position);
    const double side = box.longest_side();
    const double texel = texel_of(options_.tolerance_pct);
    told.middle = box.middle();
    told.wanted_texel_m = texel;
    told.texels = kUsualTexels;
    if (method_.detail == Detail::Budget) {
      told.texels = kLeastTexels;
      while (told.texels < kMostTexels && told.texels * texel < side) told.texels *= 2;
    }
    told.texel_m = side / told.texels;
    told.sun_directions = directions_on_sun(source_, options_.tolerance_pct);
  }

  /// As few elements as give the pilots what they are known to receive; false if that takes more
  /// than are worth it.
  bool choose_elements(RegionWork& work, const Sensors& pilots, double worth) const {
    judge_pilots(work, pilots);
    PlannedRegion& told = work.told;
    if (source_.model == nullptr) return true;
    if (method_.detail != Detail::Budget && source_.partition) {
      work.partition = *source_.partition;
      told.elements = source_.elements->size();
      return true;
    }
    const std::size_t most = source_.partition ? source_.elements->size() : kMostElements;
    const Sensors at = lifted(pilots, engines_.rays().lift_m());
    for (double n = kFewestElements; n < kMoreElements * worth; n *= kMoreElements) {
      const std::size_t count = std::min(most, static_cast<std::size_t>(n));
      work.partition = partition_of(count);
      const SkyPartition partition = partition_sky(*source_.model, work.partition);
      told.elements = partition.elements.size();
      Progress quiet;
      const SharedLight light = shared_light(engines_.rays(), engines_.rays(), at, source_,
                                             SharedElements(partition, source_.sky.get()),
                                             static_cast<int>(told.sun_directions), quiet);
      const bool is_enough = is_good_enough(work, light);
      if (!is_enough && count < most) continue;
      if (method_.detail == Detail::Budget) choose_reach(at, partition, work);
      return true;
    }
    return false;
  }

  PartitionRequest partition_of(std::size_t count) const {
    PartitionRequest request;
    if (source_.partition) request = *source_.partition;
    const bool has_count =
        request.method != PartitionMethod::Tregenza && request.method != PartitionMethod::Reinhart;
    if (!has_count || (source_.elements && count == source_.elements->size())) return request;
    request.energy_threshold_lux.reset();
    request.tolerance.reset();
    request.elements = count;
    // What maps get wrong lies along outlines, and is least where all elements weigh the same.
    if (request.method == PartitionMethod::Adaptive) request.method = PartitionMethod::Energy;
    return request;
  }

  bool is_good_enough(RegionWork& work, const SharedLight& light) const {
    std::vector<double> value(light.sky_lux.size());
    for (std::size_t k = 0; k < value.size(); ++k) value[k] = light.sky_lux[k] + light.sun_lux[k];
    const double factor = work.pilots.interval_per_scale(value, light.scale_lux);
    // Where the user wants maps, dark sensors do not drive the number of elements up: what they
    // miss of the tolerance is told.
    const double floor_share =
        method_.engine == EngineChoice::ShadowMaps ? kDark : options_.floor_share;
    const ErrorBudget budget(options_.tolerance_pct, floor_share * source_.unobstructed_lux());
    std::size_t good = 0;
    double intervals = 0.0, missed = 0.0;
    const auto count = static_cast<double>(value.size());
    for (std::size_t k = 0; k < value.size(); ++k) {
      const double interval = factor * light.scale_lux[k];
      intervals += interval;
      missed += std::abs(value[k] - work.pilots.lux[k]);
      // As the rays do: half of the tolerance (ErrorBudget).
      good += interval <= 0.5 * budget.allowed_lux(work.pilots.lux[k]) ? 1 : 0;
    }
    work.told.predicted_error_lux = intervals / count;
    if (is_picture()) {
      return missed / count <= kPictureShare * work.weight * method_.picture_tolerance_pct / 100.0 *
                                   white_lux(work.pilots);
    }
    return static_cast<double>(good) >= Pilots::kConfidence * count;
  }

  /// What the errors of a picture are seen against: open light, or in a room what is bright there.
  double white_lux(const Pilots& pilots) const {
    const double sum = std::accumulate(pilots.lux.begin(), pilots.lux.end(), 0.0);
    const double mean = sum / static_cast<double>(std::max<std::size_t>(1, pilots.lux.size()));
    return std::min(source_.unobstructed_lux(), kBright * mean);
  }

  /// How far casters matter: what the elements behind farther ones would add is within a small part
  /// of the tolerance for 95 % of the pilots.
  void choose_reach(const Sensors& at, const SkyPartition& partition, RegionWork& work) const {
    constexpr double kFirst_m = 50.0, kLast_m = 20000.0, kStep = 1.5;
    std::vector<double> reach;
    for (double r = kFirst_m; r < kLast_m; r *= kStep) reach.push_back(r);
    std::vector<std::vector<double>> loss(at.size(), std::vector<double>(reach.size()));
    parallel_for(at.size(), 1, [&](IndexRange range) {
      for (std::size_t k = range.begin; k < range.end; ++k) {
        for (const SkyElement& e : partition.elements) {
          const double lux = dot(at.normal[k], e.illuminance_vector);
          if (!(lux > 0.0) || !(dot(at.normal[k], e.direction) > 0.0)) continue;
          const auto hit = engines_.rays().first_hit(at.position[k], e.direction);
          if (!hit) continue;
          for (std::size_t r = 0; r < reach.size() && reach[r] < hit->distance_m; ++r) {
            loss[k][r] += lux;
          }
        }
      }
    });
    const ErrorBudget budget(kPartOfReach * options_.tolerance_pct,
                             options_.floor_share * source_.unobstructed_lux());
    for (std::size_t r = 0; r < reach.size(); ++r) {
      std::vector<double> lost, share;
      for (std::size_t k = 0; k < at.size(); ++k) {
        lost.push_back(loss[k][r]);
        share.push_back(loss[k][r] / budget.allowed_lux(work.pilots.lux[k]));
      }
      if (quantile(share, Pilots::kConfidence) > 1.0) continue;
      work.told.reach_m = reach[r];
      work.told.left_out_lux = quantile(lost, Pilots::kConfidence);
      return;
    }
  }

  /// Clock time of one more direction for all sensors by one engine, from that of a few.
  double seconds_a_direction(Engine engine, const Sensors& at, const PlannedRegion& told) const {
    if (source_.model == nullptr) return 0.0;
    const SkyPartition usual = partition_sky(*source_.model, partition_of(elements_asked()));
    if (engine == Engine::Rays) {
      trial_s(engines_.rays(), at, usual, kFewTrials);  // memory is touched
      return trial_s(engines_.rays(), at, usual, kRayTrials) / static_cast<double>(kRayTrials);
    }
    const auto maps = engines_.maps().with(told.texels, told.reach_m);
    const double first = trial_s(maps, at, usual, kFewTrials);  // contexts take the triangles
    const double few = std::min(first, trial_s(maps, at, usual, kFewTrials));
    const double more = trial_s(maps, at, usual, kMoreTrials);
    return std::max(0.1 * more, more - few) / static_cast<double>(kMoreTrials - kFewTrials);
  }

  /// Clock time of some of the elements, spread over the sky as all of them are: low directions
  /// cost more than high ones.
  double trial_s(const Visibility& asked, const Sensors& at, const SkyPartition& whole,
                 std::size_t count) const {
    SkyPartition some;
    for (std::size_t k = 0; k < count; ++k) {
      some.elements.push_back(whole.elements[(2 * k + 1) * whole.elements.size() / (2 * count)]);
    }
    const SharedElements trial(some, source_.sky.get());
    Progress quiet;
    const Stopwatch watch;
    trial.light(asked, at, quiet);
    return watch.seconds();
  }

  static double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    const auto last = static_cast<double>(values.size() - 1);
    return values[static_cast<std::size_t>(std::ceil(share * last))];
  }

  const Sensors& sensors_;
  const Engines& engines_;
  const DaylightSource& source_;
  const IlluminanceOptions& options_;
  const LightMethod& method_;
};

Parts parts_of(const Sensors& sensors, const IlluminanceOptions& options,
               const LightMethod& method) {
  if (method.eye) return split_by_distance(sensors, *method.eye);
  if (method.engine == EngineChoice::Rays) return {all_of(sensors.size())};
  const double texel = texel_of(options.tolerance_pct);
  return split_by_extent(sensors, kMostTexels * texel, kAlone * kLeastTexels * texel);
}

}  // namespace

std::vector<RegionWork> plan_light(const Sensors& sensors, const Engines& engines,
                                   const DaylightSource& source, const IlluminanceOptions& options,
                                   const LightMethod& method, Progress& progress) {
  std::vector<RegionWork> plan;
  if (sensors.size() == 0) return plan;
  const bool is_plain =
      (method.engine == EngineChoice::Rays && !(method.picture_tolerance_pct > 0.0)) ||
      (method.engine != EngineChoice::ShadowMaps && sensors.size() < kFewSensors);
  if (is_plain && method.detail == Detail::Budget && !method.is_predicted) {
    RegionWork all;
    all.sensor = all_of(sensors.size());
    all.told.sensors = sensors.size();
    all.told.may_interpolate =
        sensors.size() >= kFewSensors && !(method.picture_tolerance_pct > 0.0);
    all.told.why = method.engine == EngineChoice::Rays ? "asked for" : "few sensors";
    plan.push_back(std::move(all));
    return plan;
  }
  const RegionPlanner planner(sensors, engines, source, options, method);
  Parts parts = parts_of(sensors, options, method);
  progress.begin("plan", parts.size());
  for (auto& part : parts) {
    progress.stop_if_cancelled();
    RegionWork work;
    work.sensor = std::move(part);
    // What is near shows, and its maps are small.
    if (parts.size() > 1 && method.eye) work.weight = plan.empty() ? kNearShare : 2.0 - kNearShare;
    planner.plan(work);
    plan.push_back(std::move(work));
    progress.advance(1);
  }
  progress.end(std::to_string(plan.size()) + (plan.size() == 1 ? " region" : " regions"));
  return plan;
}

}  // namespace tenku
