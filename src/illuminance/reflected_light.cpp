#include "illuminance/reflected_light.h"

#include <algorithm>
#include <cmath>

#include "core/low_discrepancy.h"
#include "illuminance/sensor_sky.h"
#include "illuminance/sensor_sun.h"

namespace tenku {
namespace {

constexpr int kCertainBounces = 8;  // after these a path goes on by chance
constexpr int kMostMirrors = 8;     // in a row
constexpr std::uint64_t kLampStream = 0x6c616d7073ULL;
// Floating parts that slices along paths know, by half of what encloses them: a quarter of a
// percent of the sky. Checks find the others, and keep the values unbiased.
constexpr double kLeastPart_rad = 0.05;
constexpr int kTrueSlices = 16;  // of a true value: not by result, which would bias it

// Student's t over the normal quantile, squared: 15 and 7 degrees of freedom, at 95 %.
constexpr double kWiden15 = 1.183, kWiden7 = 1.456;

}  // namespace

Vec3 cosine_direction(Vec3 normal, double u, double v) {
  const auto [tangent, bitangent] = tangent_frame(normal);
  const double radius = std::sqrt(u), turn = 2.0 * kPi * v;
  return normalized(radius * std::cos(turn) * tangent + radius * std::sin(turn) * bitangent +
                    std::sqrt(1.0 - u) * normal);
}

/// A place where a path meets a diffuse surface.
struct ReflectedLight::Vertex {
  int order;   ///< 1 for the first
  Rgb weight;  ///< what of its exitance reaches the sensor
  const Material& material;
  std::uint32_t triangle;
  Vec3 point, normal;  ///< the normal on the side of the path
  double u, v;         ///< two more random numbers of the path, for the solar disc
  double distance_m;
};

/// A straight part of a path, up to what it meets.
struct ReflectedLight::Leg {
  int order;                       ///< of the surface that it leads to: 1 for the first
  Rgb weight;                      ///< what of that surface's exitance reaches the sensor
  bool is_direct;                  ///< from a diffuse surface or the sensor, not by way of a mirror
  Vec3 origin, normal, direction;  ///< the normal is that at the origin
};

ReflectedLight::ReflectedLight(Scene scene, int bounces, Vec3 position, Vec3 normal,
                               SampleRandom random)
    : rays_(scene.rays),
      cache_(scene.cache),
      lamps_(scene.lamps),
      lamps_apart_(scene.lamps_apart),
      bounces_(bounces),
      origin_(position + scene.rays.lift_m() * normal),
      normal_(normal),
      scramble_(random.bits()),
      batch_sum_(kBatches),
      order_sum_(static_cast<std::size_t>(bounces) + 1),
      sun_frame_(tangent_frame(scene.cache.source().sun.direction)) {}

template <class AtHit, class AtVertex>
void ReflectedLight::trace_path(PathStart start, int last_order, const AtHit& at_hit,
                                const AtVertex& at_vertex) {
  Rgb weight{1.0, 1.0, 1.0};
  Vec3 origin = origin_, normal = normal_, direction{};
  SampleRandom chance(start.scramble, start.index, 7);
  int order = 1, mirrors = 0;
  bool diffuse = true;
  while (order <= last_order) {
    if (diffuse) {
      const auto dimension = static_cast<unsigned>(2 * (order - 1));
      direction = cosine_direction(normal, sobol_owen(start.index, dimension, start.scramble),
                                   sobol_owen(start.index, dimension + 1, start.scramble));
    }
    ++rays_sent_;
    const auto hit = rays_.first_hit(origin, direction);
    if (!hit) return;
    weight = rays_.glass_transmission(origin, direction, hit->distance_m) * weight;
    at_hit(Leg{order, weight, diffuse, origin, normal, direction}, *hit);
    const Vec3 face = rays_.normal(hit->triangle);
    normal = dot(face, direction) < 0.0 ? face : -face;
    const Vec3 point = rays_.on_plane(hit->triangle, origin + hit->distance_m * direction);
    origin = point + rays_.lift_m() * normal;
    const Material& material = rays_.materials()[rays_.soup().material[hit->triangle]];
    const double diffuse_part =
        std::max({material.reflectance.r, material.reflectance.g, material.reflectance.b});
    const double to_mirror =
        material.mirror > 0.0 ? material.mirror / (material.mirror + diffuse_part) : 0.0;
    if (to_mirror > 0.0 && mirrors < kMostMirrors && chance.uniform() < to_mirror) {
      weight = (material.mirror / to_mirror) * weight;
      direction = direction - 2.0 * dot(direction, normal) * normal;
      diffuse = false;
      ++mirrors;
      continue;
    }
    if (!(to_mirror < 1.0)) return;  // a mirror alone, met too often in a row
    weight = (1.0 / (1.0 - to_mirror)) * weight;
    at_vertex(Vertex{order, weight, material, hit->triangle, point, normal, chance.uniform(),
                     chance.uniform(), hit->distance_m});
    weight = weight * material.reflectance;
    if (order >= kCertainBounces) {
      if (!(chance.uniform() < diffuse_part)) return;
      weight = (1.0 / diffuse_part) * weight;
    }
    diffuse = true;
    ++order;
  }
}

/// Of the light of a lamp met by chance: what looking at lamps leaves to chance.
double ReflectedLight::share_by_chance(const Leg& leg, std::uint32_t triangle,
                                       double distance_m) const {
  if (!leg.is_direct) return 1.0;
  const LampSampler::View view(lamps_, leg.origin, leg.normal);
  if (!view.is_worth_looking()) return 1.0;
  const double by_chance = dot(leg.normal, leg.direction) / kPi;
  return by_chance / (by_chance + view.density(triangle, distance_m * leg.direction));
}

/// Illuminance by one point of the lamps.
/// @param order  of the surface that looks: 0 for the sensor
Rgb ReflectedLight::look_at_lamps(Vec3 origin, Vec3 normal, PathStart start, int order) {
  if (!lamps_.is_any()) return {};
  const LampSampler::View view(lamps_, origin, normal);
  if (!view.is_worth_looking()) return {};
  const auto dimension = static_cast<unsigned>(2 * order);
  const std::uint64_t scramble = mix_bits(start.scramble ^ kLampStream);
  const auto [triangle, position] = view.choose(sobol_owen(start.index, dimension, scramble),
                                                sobol_owen(start.index, dimension + 1, scramble));
  const Vec3 way = position - origin;
  const double away = length(way);
  if (!(dot(way, normal) > 0.0)) return {};
  const Vec3 direction = (1.0 / away) * way;
  ++rays_sent_;
  const auto hit = rays_.first_hit(origin, direction);
  if (!hit || hit->triangle != triangle) return {};
  const double by_chance = dot(normal, direction) / kPi;
  const double share = by_chance / (by_chance + view.density(triangle, way));
  const Material& lamp = rays_.materials()[rays_.soup().material[triangle]];
  return share * rays_.glass_transmission(origin, direction, away) * lamp.emission_lm_m2;
}

void ReflectedLight::trace_looked_up(int goal) {
  for (; looked_up_paths_ < goal; ++looked_up_paths_) {
    const auto batch = static_cast<std::size_t>(looked_up_paths_ % kBatches);
    const PathStart start{static_cast<std::uint32_t>(looked_up_paths_ / kBatches),
                          mix_bits(scramble_ + batch)};
    const auto add = [&](int order, Rgb arriving) {
      const double lux = luminance_of(arriving);
      looked_up_sum_ = looked_up_sum_ + arriving;
      batch_sum_[batch] += lux;
      order_sum_[static_cast<std::size_t>(order)] += lux;
    };
    if (bounces_ > 0 && !lamps_apart_) add(1, look_at_lamps(origin_, normal_, start, 0));
    const auto at_hit = [&](const Leg& leg, const RayHit& hit) {
      const Material& lamp = rays_.materials()[rays_.soup().material[hit.triangle]];
      if (!(luminance_of(lamp.emission_lm_m2) > 0.0)) return;
      if (lamps_apart_ && leg.order == 1 && leg.is_direct) return;
      add(leg.order,
          share_by_chance(leg, hit.triangle, hit.distance_m) * leg.weight * lamp.emission_lm_m2);
    };
    trace_path(start, bounces_, at_hit, [&](const Vertex& v) {
      const std::uint64_t address =
          mix_bits(mix_bits(start.scramble + start.index) ^ static_cast<unsigned>(v.order));
      const double direct = sky_lux(v, address) + sun_lux(v.point, v.normal, v.u, v.v);
      add(v.order, v.weight * (direct * v.material.reflectance));
      if (v.order == bounces_) return;
      const Vec3 origin = v.point + rays_.lift_m() * v.normal;
      const Rgb of_lamps = look_at_lamps(origin, v.normal, start, v.order);
      add(v.order + 1, v.weight * v.material.reflectance * of_lamps);
    });
  }
  const double per_batch = static_cast<double>(looked_up_paths_) / kBatches;
  double sum = 0.0, squares = 0.0;
  for (const double batch : batch_sum_) sum += batch / per_batch;
  const double mean = sum / kBatches;
  for (const double batch : batch_sum_) squares += std::pow(batch / per_batch - mean, 2);
  looked_up_rgb_ = (1.0 / looked_up_paths_) * looked_up_sum_;
  looked_up_ = {mean, kWiden15 * squares / (kBatches * (kBatches - 1.0))};
}

void ReflectedLight::trace_differences(int goal) {
  for (; difference_paths_ < goal; ++difference_paths_) {
    const auto index = static_cast<std::uint32_t>(difference_paths_);
    const PathStart start{index, mix_bits(scramble_ ^ 0x5851f42d4c957f2dU)};
    // One surface of the path is looked at, the nearer ones more often.
    SampleRandom chance(start.scramble, index, 9);
    int order = 1;
    double probability = 1.0;
    for (; order < bounces_; ++order) {
      const bool stop = chance.uniform() < 0.5;
      probability *= 0.5;
      if (stop) break;
    }
    Rgb arriving{};
    const auto no_lamps = [](const Leg&, const RayHit&) {};
    trace_path(start, order, no_lamps, [&](const Vertex& v) {
      if (v.order != order) return;
      const std::uint64_t address = mix_bits(start.scramble + index);
      const double missed = true_sky_lux(v.point, v.normal, address, kTrueSlices) -
                            cache_.lux(v.triangle, v.point, v.normal, v.distance_m);
      arriving = (missed / probability) * (v.weight * v.material.reflectance);
    });
    const double lux = luminance_of(arriving);
    difference_rgb_sum_ = difference_rgb_sum_ + arriving;
    difference_sum_ += lux;
    difference_squares_ += lux * lux;
  }
  const double n = difference_paths_, mean = difference_sum_ / n;
  const double variance = std::max(0.0, difference_squares_ / n - mean * mean) / (n - 1.0);
  difference_rgb_ = (1.0 / n) * difference_rgb_sum_;
  difference_ = {mean, variance * (difference_paths_ <= kFirstDifferences ? kWiden7 : kWiden15)};
}

double ReflectedLight::sun_lux(Vec3 point, Vec3 normal, double u, double v) {
  const SolarDisc& sun = cache_.source().sun;
  if (!(sun.normal_illuminance > Illuminance(0.0))) return 0.0;
  const Vec3 direction = direction_on_disc(sun, sun_frame_, u, v);
  const double cosine = dot(normal, direction);
  if (!(cosine > 0.0) || !(direction.z > 0.0)) return 0.0;
  const Vec3 origin = point + rays_.lift_m() * normal;
  ++rays_sent_;
  if (rays_.is_occluded(origin, direction)) return 0.0;
  return sun.normal_illuminance.value() * cosine * rays_.glass_transmission(origin, direction);
}

double ReflectedLight::sky_lux(const Vertex& v, std::uint64_t address) {
  if (way_ == SkyBy::Cache) return cache_.lux(v.triangle, v.point, v.normal, v.distance_m);
  return cache_.source().sky ? true_sky_lux(v.point, v.normal, address, 1) : 0.0;
}

double ReflectedLight::true_sky_lux(Vec3 point, Vec3 normal, std::uint64_t address, int slices) {
  SensorSky sky(
      rays_, cache_.source().sky.get(), point, normal, SampleRandom(scramble_, address, 2),
      SensorSky::Effort{.first_slices = slices,
                        .outlined = false,
                        .least_part_rad = slices > 1 ? kLeastPart_rad : SliceTracer::kNoParts});
  sky.refine();
  rays_sent_ += sky.rays_sent();
  return sky.signed_lux();
}

void ReflectedLight::refine() {
  const bool differs = way_ == SkyBy::Cache && cache_.source().sky != nullptr;
  const std::uint64_t before = rays_sent_;
  if (looked_up_paths_ == 0 || looked_up_.variance * static_cast<double>(difference_rays_) >=
                                   difference_.variance * static_cast<double>(looked_up_rays_)) {
    trace_looked_up(looked_up_paths_ == 0 ? kFirstPaths : 2 * looked_up_paths_);
    looked_up_rays_ += rays_sent_ - before;
    if (difference_paths_ > 0 || !differs) return;
  }
  const std::uint64_t between = rays_sent_;
  trace_differences(difference_paths_ == 0 ? kFirstDifferences : 2 * difference_paths_);
  difference_rays_ += rays_sent_ - between;
}

double ReflectedLight::left_out_lux() const {
  if (looked_up_paths_ == 0 || bounces_ < 1) return 0.0;
  const double last = order_sum_[static_cast<std::size_t>(bounces_)] / looked_up_paths_;
  if (bounces_ == 1) return last;  // nothing tells how fast it falls
  const double before = order_sum_[static_cast<std::size_t>(bounces_) - 1] / looked_up_paths_;
  double most = 0.0;
  for (const Material& m : rays_.materials()) {
    most = std::max({most, m.reflectance.r, m.reflectance.g, m.reflectance.b});
  }
  // Two orders of few paths do not tell a ratio near one apart from a smaller one.
  constexpr double kBright = 0.95;
  const double ratio = before <= 0.0    ? 0.0
                       : most > kBright ? most
                                        : std::min(last / before, kBright);
  return last * ratio / (1.0 - ratio);
}

}  // namespace tenku
