#include "illuminance/reflected_sharing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/parallel.h"
#include "core/random.h"
#include "illuminance/pilots.h"

namespace tenku {
namespace {

constexpr double kFacingSteps = 4.0;  // of a normal's component that counts as one way
constexpr double kWideCell_m = 50.0;  // beyond, a cell holds many surfaces
constexpr double kLikeView = 0.1;     // of the sky, by which sensors that are alike may differ
constexpr std::size_t kPilots = 300;  // flat ones, and as many steep ones
constexpr double kUnknown = 0.05;     // of a blend: what its parts may all have missed
constexpr std::uint32_t kNone = ~0U;

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
    : sensors_(sensors),
      rays_(rays),
      layout_(std::move(layout)),
      cells_(layout_.place, layout_.surface, layout_.reach),
      own_(sensors.size(), kNone) {
  choose_representatives();
  if (layout_.is_measured) draw_pilots();
}

void ReflectedSharing::choose_representatives() {
  for (const std::uint32_t s : shuffled(sensors_.size())) {
    if (has_representative(s)) continue;
    own_[s] = static_cast<std::uint32_t>(calculated_.size());
    cells_.add(s, own_[s]);
    calculated_.push_back(s);
  }
  representatives_ = calculated_.size();
}

void ReflectedSharing::draw_pilots() {
  std::array<std::size_t, 2> drawn{};
  for (const std::uint32_t s : shuffled(sensors_.size())) {
    std::size_t& of_its_kind = drawn[is_flat(sensors_.normal[s])];
    const bool sees_none = !layout_.sky_view.empty() && !(layout_.sky_view[s] > 0.0);
    if (own_[s] != kNone || sees_none || of_its_kind == kPilots) continue;
    ++of_its_kind;
    own_[s] = static_cast<std::uint32_t>(calculated_.size());
    calculated_.push_back(s);
  }
}

bool ReflectedSharing::is_like(std::size_t sensor, std::size_t other) const {
  if (layout_.sky_view.empty()) return true;
  const double a = layout_.sky_view[sensor], b = layout_.sky_view[other];
  return (a > 0.0) == (b > 0.0) && std::abs(a - b) <= kLikeView;
}

bool ReflectedSharing::is_seen(std::size_t sensor, std::size_t other) const {
  return !layout_.must_see || see_each_other(sensors_, sensor, other, rays_);
}

bool ReflectedSharing::has_representative(std::size_t sensor) const {
  const std::vector<std::uint32_t>& beside = cells_.beside(sensor);
  return std::any_of(beside.begin(), beside.end(), [&](std::uint32_t r) {
    return is_like(sensor, calculated_[r]) && is_seen(sensor, calculated_[r]);
  });
}

ReflectedSharing::Blend ReflectedSharing::blend_at(std::size_t sensor,
                                                   const std::vector<std::uint32_t>& around,
                                                   const SensorIlluminance& of_calculated) const {
  Rgb rgb{};
  double weight = 0.0, lux = 0.0, squares = 0.0, errors = 0.0, squared_errors = 0.0;
  for (const std::uint32_t r : around) {
    const std::size_t other = calculated_[r];
    if (!is_like(sensor, other) || !is_seen(sensor, other)) continue;
    const double away = length(layout_.place[other] - layout_.place[sensor]) / layout_.reach;
    const double w = std::exp(-away * away) + 1e-6;
    const double value = of_calculated.reflected_lux[r], error = of_calculated.error_lux[r];
    rgb = rgb + w * of_calculated.reflected_rgb[r];
    weight += w, lux += w * value, squares += w * value * value;
    errors += w * error, squared_errors += std::pow(w * error, 2);
  }
  Blend blend;  // its own representative is always among them
  blend.lux = lux / weight;
  blend.rgb = (1.0 / weight) * rgb;
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
    if (is_flat(sensors_.normal[calculated_[r]]) != flat) continue;
    const Blend blend = blend_at(calculated_[r], cells_.around(calculated_[r]), of_calculated);
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
  parallel_for(sensors_.size(), 1024, [&](IndexRange range) {
    CellsAround around(cells_);  // neighbours in the list mostly share a cell
    for (std::size_t s = range.begin; s < range.end; ++s) {
      const std::uint32_t own = own_[s];
      const Blend blend =
          own != kNone ? Blend{of_calculated.reflected_lux[own], of_calculated.error_lux[own], 0.0,
                               of_calculated.reflected_rgb[own]}
                       : blend_at(s, around.of(s), of_calculated);
      const bool is_measured = own == kNone && layout_.is_measured;
      const double error =
          is_measured ? factor[is_flat(sensors_.normal[s])] * blend.scale_lux : blend.error_lux;
      all.reflected_lux[s] = blend.lux;
      all.reflected_rgb[s] = blend.rgb;
      all.error_lux[s] = std::hypot(all.error_lux[s], error);
    }
  });
}

}  // namespace tenku
