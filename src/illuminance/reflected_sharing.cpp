#include "illuminance/reflected_sharing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/parallel.h"
#include "core/random.h"
#include "illuminance/pilots.h"

namespace tenku {
namespace {

constexpr double kNormalSteps = 50.0;  // of a normal's component that counts as one plane
constexpr double kOffsetSteps = 2.0;   // a metre
constexpr double kFacingSteps = 4.0;   // of a normal's component that counts as one way
constexpr double kWideCell_m = 50.0;   // beyond, a cell holds many surfaces
constexpr double kLikeView = 0.1;      // of the sky, by which sensors that are alike may differ
constexpr std::size_t kPilots = 300;   // flat ones, and as many steep ones
constexpr double kUnknown = 0.05;      // of a blend: what its parts may all have missed
constexpr std::uint32_t kNone = ~0U;

bool is_flat_normal(Vec3 normal) { return std::abs(normal.z) > 0.9; }

std::uint64_t plane_of(Vec3 n, Vec3 p) {
  // A gently rolling ground is one surface: only what is steep is told apart by its offset.
  const bool flat = is_flat_normal(n);
  const double steps = flat ? kNormalSteps / 10.0 : kNormalSteps;
  const double offset = flat ? 0.0 : kOffsetSteps * dot(n, p);
  return mix_rounded(0, {steps * n.x, steps * n.y, steps * n.z, offset});
}

/// All indices, in an order that does not follow that of the surfaces: the first sensors of a
/// triangle are its corners, where least can be seen.
std::vector<std::size_t> shuffled(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [](std::size_t a, std::size_t b) { return mix_bits(a) < mix_bits(b); });
  return order;
}

}  // namespace

std::uint64_t facing(Vec3 normal) {
  return mix_rounded(0,
                     {kFacingSteps * normal.x, kFacingSteps * normal.y, kFacingSteps * normal.z});
}

SharingLayout sharing_by_distance(const Sensors& sensors, const std::vector<double>& sky_view,
                                  double distance_m) {
  SharingLayout layout;
  layout.sky_view = sky_view;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    layout.place.push_back((1.0 / distance_m) * sensors.position[s]);
    layout.surface.push_back(distance_m > kWideCell_m
                                 ? facing(sensors.normal[s])
                                 : plane_of(sensors.normal[s], sensors.position[s]));
  }
  return layout;
}

ReflectedSharing::ReflectedSharing(const Sensors& sensors, SharingLayout layout,
                                   const RayVisibility& rays)
    : sensors_(sensors), rays_(rays), layout_(std::move(layout)), own_(sensors.size(), kNone) {
  bool is_level = true;
  for (const Vec3 place : layout_.place) is_level &= place.z == layout_.place[0].z;
  const int reach = layout_.reach, up = is_level ? 0 : reach;
  for (int k = -up; k <= up; ++k) {
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) {
        steps_.push_back({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
      }
    }
  }
  choose_representatives();
  if (layout_.is_measured) draw_pilots();
}

void ReflectedSharing::choose_representatives() {
  for (const std::size_t s : shuffled(sensors_.size())) {
    if (has_representative(s)) continue;
    own_[s] = static_cast<std::uint32_t>(calculated_.size());
    in_cell_[cell_key(s, {})].push_back(own_[s]);
    calculated_.push_back(static_cast<std::uint32_t>(s));
  }
  representatives_ = calculated_.size();
}

void ReflectedSharing::draw_pilots() {
  std::array<std::size_t, 2> drawn{};
  for (const std::size_t s : shuffled(sensors_.size())) {
    std::size_t& of_its_kind = drawn[is_flat(s)];
    const bool sees_none = !layout_.sky_view.empty() && !(layout_.sky_view[s] > 0.0);
    if (own_[s] != kNone || sees_none || of_its_kind == kPilots) continue;
    ++of_its_kind;
    own_[s] = static_cast<std::uint32_t>(calculated_.size());
    calculated_.push_back(static_cast<std::uint32_t>(s));
  }
}

std::uint64_t ReflectedSharing::cell_key(std::size_t sensor, Vec3 steps_away) const {
  const Vec3 place = layout_.place[sensor];
  return mix_rounded(layout_.surface[sensor],
                     {std::floor(place.x) + steps_away.x, std::floor(place.y) + steps_away.y,
                      std::floor(place.z) + steps_away.z});
}

bool ReflectedSharing::is_flat(std::size_t sensor) const {
  return is_flat_normal(sensors_.normal[sensor]);
}

bool ReflectedSharing::is_like(std::size_t sensor, std::size_t other) const {
  if (layout_.sky_view.empty()) return true;
  const double a = layout_.sky_view[sensor], b = layout_.sky_view[other];
  return (a > 0.0) == (b > 0.0) && std::abs(a - b) <= kLikeView;
}

bool ReflectedSharing::is_seen(std::size_t sensor, std::size_t other) const {
  if (!layout_.must_see) return true;
  const Vec3 at = sensors_.position[sensor] + rays_.lift_m() * sensors_.normal[sensor];
  const Vec3 way = sensors_.position[other] + rays_.lift_m() * sensors_.normal[other] - at;
  const double away = length(way);
  if (!(away > 1e-6)) return true;
  const auto hit = rays_.first_hit(at, (1.0 / away) * way);
  return !hit || hit->distance_m >= away;
}

bool ReflectedSharing::has_representative(std::size_t sensor) const {
  const auto cell = in_cell_.find(cell_key(sensor, {}));
  if (cell == in_cell_.end()) return false;
  return std::any_of(cell->second.begin(), cell->second.end(), [&](std::uint32_t r) {
    return is_like(sensor, calculated_[r]) && is_seen(sensor, calculated_[r]);
  });
}

ReflectedSharing::Blend ReflectedSharing::blend_at(std::size_t sensor,
                                                   const SensorIlluminance& of_calculated) const {
  double weight = 0.0, lux = 0.0, squares = 0.0, errors = 0.0, squared_errors = 0.0;
  for (const Vec3 step : steps_) {
    const auto cell = in_cell_.find(cell_key(sensor, step));
    if (cell == in_cell_.end()) continue;
    for (const std::uint32_t r : cell->second) {
      const std::size_t other = calculated_[r];
      if (!is_like(sensor, other) || !is_seen(sensor, other)) continue;
      const double away = length(layout_.place[other] - layout_.place[sensor]) / layout_.reach;
      const double w = std::exp(-away * away) + 1e-6;
      const double value = of_calculated.reflected_lux[r], error = of_calculated.error_lux[r];
      weight += w, lux += w * value, squares += w * value * value;
      errors += w * error, squared_errors += std::pow(w * error, 2);
    }
  }
  Blend blend;  // its own representative is always among them
  blend.lux = lux / weight;
  blend.error_lux = (layout_.is_measured ? std::sqrt(squared_errors) : errors) / weight;
  const double disagree = std::max(0.0, squares / weight - blend.lux * blend.lux);
  blend.scale_lux = std::hypot(blend.error_lux, std::sqrt(disagree), kUnknown * blend.lux);
  return blend;
}

double ReflectedSharing::interval_per_scale(bool flat,
                                            const SensorIlluminance& of_calculated) const {
  Pilots pilots;
  std::vector<double> value, scale;
  for (std::size_t r = representatives_; r < calculated_.size(); ++r) {
    if (is_flat(calculated_[r]) != flat) continue;
    const Blend blend = blend_at(calculated_[r], of_calculated);
    if (!(blend.scale_lux > 0.0)) continue;
    pilots.lux.push_back(of_calculated.reflected_lux[r]);
    value.push_back(blend.lux);
    scale.push_back(blend.scale_lux);
  }
  return pilots.interval_per_scale(value, scale);
}

void ReflectedSharing::spread(const SensorIlluminance& of_calculated,
                              SensorIlluminance& all) const {
  const std::array<double, 2> factor{interval_per_scale(false, of_calculated),
                                     interval_per_scale(true, of_calculated)};
  parallel_for(sensors_.size(), 256, [&](IndexRange range) {
    for (std::size_t s = range.begin; s < range.end; ++s) {
      const std::uint32_t own = own_[s];
      const Blend blend =
          own != kNone ? Blend{of_calculated.reflected_lux[own], of_calculated.error_lux[own], 0.0}
                       : blend_at(s, of_calculated);
      const bool is_measured = own == kNone && layout_.is_measured;
      const double error = is_measured ? factor[is_flat(s)] * blend.scale_lux : blend.error_lux;
      all.reflected_lux[s] = blend.lux;
      all.error_lux[s] = std::hypot(all.error_lux[s], error);
    }
  });
}

}  // namespace tenku
