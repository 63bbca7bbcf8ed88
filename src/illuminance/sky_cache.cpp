#include "illuminance/sky_cache.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <unordered_map>

#include "core/closest_point.h"
#include "core/random.h"
#include "illuminance/sensor_sky.h"

namespace tenku {
namespace {

constexpr double kPitchPerDistance = 0.125;
constexpr double kFar_m = 10.0;
constexpr double kLeastPitch_m = 0.0625;
constexpr double kRelativeError = 0.1;   // of a value, as far as slices can tell
constexpr double kWorthKnowing = 0.005;  // of the horizontal sky illuminance
constexpr int kMostSlices = 64;
constexpr double kLeastPart_rad = 0.03;  // half of what encloses it: a thousandth of the sky

struct Cell {
  std::uint64_t key;
  Vec3 centre;
  double pitch;
};

Cell cell_of(std::uint32_t triangle, bool front, Vec3 point, double distance_m) {
  const double near = std::min(1.0, std::sqrt(distance_m / kFar_m));  // finer in rooms
  const double wanted = std::max(kPitchPerDistance * distance_m * near, kLeastPitch_m);
  const int level = static_cast<int>(std::ceil(std::log2(wanted)));
  const double pitch = std::exp2(level);
  const double i = std::floor(point.x / pitch), j = std::floor(point.y / pitch),
               k = std::floor(point.z / pitch);
  std::uint64_t key = mix_bits(2 * std::uint64_t{triangle} + (front ? 1 : 0));
  key = mix_bits(key + static_cast<std::uint64_t>(level + 64));
  key = mix_rounded(key, {i, j, k});
  return {key, {(i + 0.5) * pitch, (j + 0.5) * pitch, (k + 0.5) * pitch}, pitch};
}

}  // namespace

struct SkyCache::Shard {
  std::mutex mutex;
  std::unordered_map<std::uint64_t, float> value;
};

SkyCache::SkyCache(const RayVisibility& rays, const DaylightSource& source, std::uint64_t seed)
    : rays_(rays),
      source_(source),
      seed_(seed),
      shards_(std::make_unique<std::array<Shard, kShards>>()) {}

SkyCache::~SkyCache() = default;

double SkyCache::lux(std::uint32_t triangle, Vec3 point, Vec3 normal, double distance_m) {
  const bool front = dot(normal, rays_.normal(triangle)) > 0.0;
  const Cell cell = cell_of(triangle, front, point, distance_m);
  Shard& shard = (*shards_)[cell.key % kShards];
  {
    const std::lock_guard lock(shard.mutex);
    if (const auto found = shard.value.find(cell.key); found != shard.value.end()) {
      return found->second;
    }
  }
  const TriangleSoup& soup = rays_.soup();
  const auto& [a, b, c] = soup.triangles[triangle];
  const Vec3 va = soup.vertices[a], vb = soup.vertices[b], vc = soup.vertices[c];
  // A little toward the middle, off the edges, where neighbours would hide half of the sky.
  const Vec3 edge_point = closest_on_triangle(cell.centre, va, vb, vc);
  const Vec3 inward = (1.0 / 3.0) * (va + vb + vc) - edge_point;
  const double shift = std::min(0.02, 0.02 * cell.pitch / std::max(length(inward), 1e-9));
  const Vec3 place = edge_point + shift * inward;
  const auto value = static_cast<float>(measure(place, normal, cell.key));
  const std::lock_guard lock(shard.mutex);
  shard.value.emplace(cell.key, value);
  return value;
}

double SkyCache::measure(Vec3 point, Vec3 normal, std::uint64_t key) {
  if (!source_.sky) return 0.0;
  SensorSky sky(rays_, source_.sky.get(), point, normal, SampleRandom(seed_, key, 1),
                SensorSky::Effort{
                    .checked = false, .sure_of_parts = false, .least_part_rad = kLeastPart_rad});
  const double floor_lux = kWorthKnowing * source_.sky->horizontal_lux();
  do {
    sky.refine();
  } while (sky.slices() < kMostSlices &&
           (sky.may_miss_openings() ||
            std::sqrt(sky.variance()) > kRelativeError * std::max(sky.lux(), floor_lux)));
  rays_sent_ += sky.rays_sent();
  return sky.lux();
}

}  // namespace tenku
