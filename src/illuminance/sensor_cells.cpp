#include "illuminance/sensor_cells.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/random.h"
#include "illuminance/sensor_regions.h"

namespace tenku {
namespace {

constexpr double kNormalSteps = 50.0;  // of a normal's component that counts as one plane
constexpr double kOffsetSteps = 2.0;   // a metre

}  // namespace

SensorCells::SensorCells(std::vector<Vec3> place, std::vector<std::uint64_t> surface, int reach)
    : place_(std::move(place)), surface_(std::move(surface)), reach_(reach) {
  const bool is_level =
      std::all_of(place_.begin(), place_.end(), [&](Vec3 p) { return p.z == place_.front().z; });
  const int up = is_level ? 0 : reach;
  for (int k = -up; k <= up; ++k) {
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) {
        steps_.push_back({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
      }
    }
  }
}

std::vector<std::uint32_t> SensorCells::around(std::size_t sensor) const {
  std::vector<std::uint32_t> values;
  around(sensor, [&](std::uint32_t value) { values.push_back(value); });
  return values;
}

std::uint64_t SensorCells::key(std::size_t sensor, Vec3 steps_away) const {
  const Vec3 place = place_[sensor];
  return mix_rounded(surface_[sensor],
                     {std::floor(place.x) + steps_away.x, std::floor(place.y) + steps_away.y,
                      std::floor(place.z) + steps_away.z});
}

const std::vector<std::uint32_t>& SensorCells::values_at(std::uint64_t key) const {
  static const std::vector<std::uint32_t> kNothing;
  const auto cell = in_cell_.find(key);
  return cell == in_cell_.end() ? kNothing : cell->second;
}

std::uint64_t plane_of(Vec3 n, Vec3 p) {
  // Only what is steep is told apart by its offset.
  const bool flat = is_flat(n);
  const double steps = flat ? kNormalSteps / 10.0 : kNormalSteps;
  const double offset = flat ? 0.0 : kOffsetSteps * dot(n, p);
  return mix_rounded(0, {steps * n.x, steps * n.y, steps * n.z, offset});
}

std::vector<Vec3> places_in_cells(const Sensors& sensors, double cell_m) {
  std::vector<Vec3> places;
  places.reserve(sensors.size());
  for (const Vec3& p : sensors.position) places.push_back((1.0 / cell_m) * p);
  return places;
}

double sensors_in_cell(const Sensors& sensors, const std::vector<std::uint64_t>& surface,
                       double cell_m) {
  std::unordered_map<std::uint64_t, std::size_t> cells;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    const Vec3 p = (1.0 / cell_m) * sensors.position[s];
    ++cells[mix_rounded(surface[s], {std::floor(p.x), std::floor(p.y), std::floor(p.z)})];
  }
  double squares = 0.0;
  for (const auto& [key, count] : cells) squares += static_cast<double>(count * count);
  return squares / static_cast<double>(sensors.size());
}

double cell_with(double sensors_in_it, const Sensors& sensors,
                 const std::vector<std::uint64_t>& surface) {
  constexpr double kFinest_m = 0.01, kCoarsest_m = 1000.0;
  double cell_m = kFinest_m;
  while (cell_m < kCoarsest_m && sensors_in_cell(sensors, surface, 2.0 * cell_m) <= sensors_in_it) {
    cell_m *= 2.0;
  }
  return cell_m;
}

bool see_each_other(const Sensors& sensors, std::size_t a, std::size_t b,
                    const RayVisibility& rays) {
  const Vec3 at = sensors.position[a] + rays.lift_m() * sensors.normal[a];
  const Vec3 way = sensors.position[b] + rays.lift_m() * sensors.normal[b] - at;
  const double away = length(way);
  if (!(away > 1e-6)) return true;
  const auto hit = rays.first_hit(at, (1.0 / away) * way);
  return !hit || hit->distance_m >= away;
}

std::vector<std::uint32_t> shuffled(std::size_t count) {
  std::vector<std::uint32_t> order = all_of(count);
  std::sort(order.begin(), order.end(),
            [](std::uint32_t a, std::uint32_t b) { return mix_bits(a) < mix_bits(b); });
  return order;
}

}  // namespace tenku
